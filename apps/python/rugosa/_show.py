"""Pictures of objects by matplotlib: .plot(), and _repr_html_ for notebooks."""

import io
from html import escape


def _axes(axes, **labels):
    """The given axes, or new ones, with these labels."""
    if axes is None:
        import matplotlib.pyplot as plt
        axes = plt.subplots()[1]
    axes.set(**labels)
    return axes


def _plot_curve(curve, axes=None, **style):
    """Tangent stiffness against pressure; returns the axes."""
    axes = _axes(axes, xlabel="pressure / MPa", ylabel="stiffness / (MPa/mm)")
    axes.plot(curve.pressure, curve.tangent_stiffness, **style)
    return axes


def _plot_profile(profile, axes=None, **style):
    """Heights along the profile; returns the axes."""
    axes = _axes(axes, xlabel="x / mm", ylabel="height / mm")
    axes.plot([i * profile.spacing for i in range(profile.nodes)], profile.heights, **style)
    return axes


def _plot_surface(surface, axes=None, **style):
    """Heights as a picture; returns the axes."""
    axes = _axes(axes, xlabel="x / mm", ylabel="y / mm")
    (dx, dy), (nx, ny) = surface.spacing, surface.nodes
    picture = axes.imshow(surface.heights, origin="lower", extent=(0, nx * dx, 0, ny * dy), **style)
    axes.figure.colorbar(picture, ax=axes, label="height / mm")
    return axes


def _answer(curve, quantity):
    """The points of a quantity from which the similarity is computed, and the labels of its axes."""
    pressure, displacement, fraction = "pressure / MPa", "displacement / mm", "contact fraction"
    if quantity.endswith("stiffness"):
        p, stiffness = curve.secant_stiffness()
        if quantity == "interface_stiffness":
            stiffness = 1 / (1 / stiffness - 1 / curve.full_stiffness)
        return p, stiffness, pressure, quantity.replace("_", " ") + " / (MPa/mm)"
    return {"area": (curve.pressure, curve.contact_fraction, pressure, fraction),
            "area-displacement": (curve.displacement, curve.contact_fraction, displacement, fraction),
            "load": (curve.displacement, curve.pressure, displacement, pressure)}[quantity]


def _plot_design(design, axes=None):
    """The answer and the targets; returns the axes. If there are several quantities, axes are a list."""
    quantities = list(dict.fromkeys(target.quantity for target in design.targets))
    if axes is None:
        import matplotlib.pyplot as plt
        n = len(quantities)
        axes = list(plt.subplots(1, n, squeeze=False, layout="constrained", figsize=(6.4 * n, 4.8))[1][0])
    each = [axes] if hasattr(axes, "plot") else list(axes)
    if len(each) != len(quantities):
        raise ValueError(f"axes: {len(each)} were given; give one for each of {', '.join(quantities)}")
    for quantity, one in zip(quantities, each):
        x, y, x_label, y_label = _answer(design.curve, quantity)
        for target in design.targets:
            if target.quantity == quantity:
                one.plot(target.x, target.y, "o", label="target")
        one.plot(x, y, label="answer")
        _axes(one, xlabel=x_label, ylabel=y_label).legend()
        one.ticklabel_format(scilimits=(-3, 3))
    return each[0] if len(each) == 1 else each


def _picture(thing):
    """The plot as SVG, or nothing without matplotlib: a notebook then shows the object's text."""
    try:
        from matplotlib.figure import Figure
    except ImportError:
        return None
    svg = io.StringIO()
    axes = Figure(figsize=(5, 2.5), layout="constrained").subplots()
    thing.plot(axes)
    axes.figure.savefig(svg, format="svg")
    return svg.getvalue()[svg.getvalue().index("<svg"):]


def _design_box(design):
    worst = design.similarity_worst
    verdict = ("found" if design.found else "; ".join(design.out_of_reach)
               or ("not verified" if worst is None else "not found"))
    worst = "none" if worst is None else f"{worst:.4f}"
    return (f'<div style="border:1px solid #888;padding:8px"><b>{escape(verdict)}</b>: similarity '
            f"{worst} (lowest), {design.similarity:.4f} on the grid of the design<br>"
            f"{_picture(design.profile) or ''}{_picture(design.curve) or ''}</div>")


def attach(curve, profile, surface, design):
    """Adds the pictures to the classes of the module."""
    curve.plot, profile.plot, surface.plot, design.plot = _plot_curve, _plot_profile, _plot_surface, _plot_design
    curve._repr_html_ = profile._repr_html_ = surface._repr_html_ = _picture
    design._repr_html_ = _design_box
