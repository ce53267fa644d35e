"""Pictures of objects: .plot() by matplotlib, _repr_html_ by a few lines of SVG."""

import base64
import struct
import zlib
from html import escape


def _axes(axes):
    if axes is not None:
        return axes
    import matplotlib.pyplot as plt
    return plt.subplots()[1]


def _plot_curve(curve, axes=None, **style):
    """Tangent stiffness against pressure; returns the axes."""
    axes = _axes(axes)
    axes.plot(curve.pressure, curve.tangent_stiffness, **style)
    axes.set_xlabel("pressure / MPa")
    axes.set_ylabel("stiffness / (MPa/mm)")
    return axes


def _plot_profile(profile, axes=None, **style):
    """Heights along the profile; returns the axes."""
    axes = _axes(axes)
    axes.plot([i * profile.spacing for i in range(profile.nodes)], profile.heights, **style)
    axes.set_xlabel("x / mm")
    axes.set_ylabel("height / mm")
    return axes


def _plot_surface(surface, axes=None, **style):
    """Heights as a picture; returns the axes."""
    axes = _axes(axes)
    (dx, dy), (nx, ny) = surface.spacing, surface.nodes
    picture = axes.imshow(surface.heights, origin="lower", extent=(0, nx * dx, 0, ny * dy), **style)
    axes.set_xlabel("x / mm")
    axes.set_ylabel("y / mm")
    axes.figure.colorbar(picture, ax=axes, label="height / mm")
    return axes


def _plot_design(design, axes=None):
    """The secant stiffness of the answer and the targets; returns the axes."""
    axes = _axes(axes)
    for target in design.targets:
        axes.plot(target.x, target.y, "o", label=f"target: {target.quantity}")
    if any(target.quantity == "stiffness" for target in design.targets):
        axes.plot(*design.curve.secant_stiffness(), label="answer")
    axes.legend()
    return axes


def _picture(x, y, label, width=320, height=120):
    low, high = float(min(y)), float(max(y))
    left, right = float(min(x)), float(max(x))
    points = " ".join(f"{(float(a) - left) / ((right - left) or 1) * width:.1f},"
                      f"{height - (float(b) - low) / ((high - low) or 1) * height:.1f}" for a, b in zip(x, y))
    return (f'<figure style="display:inline-block;margin:4px"><svg width="{width}" height="{height}" role="img">'
            f'<polyline points="{points}" fill="none" stroke="#2563a8" stroke-width="1.5"/></svg>'
            f"<figcaption>{escape(label)}</figcaption></figure>")


def _profile_picture(profile):
    every = max(1, profile.nodes // 1000)
    heights = profile.heights[::every]
    return _picture([i * every * profile.spacing for i in range(len(heights))], heights,
                    f"height, {heights.min():.3g} to {heights.max():.3g} mm, over "
                    f"{profile.nodes * profile.spacing:.4g} mm")


def _surface_picture(surface):
    every = max(1, max(surface.nodes) // 160)
    heights = surface.heights[::-every, ::every]  # y grows upwards
    low, high = heights.min(), heights.max()
    grey = ((heights - low) / ((high - low) or 1) * 255).round().astype("uint8")
    rows, columns = grey.shape

    def chunk(kind, content):
        return (struct.pack(">I", len(content)) + kind + content
                + struct.pack(">I", zlib.crc32(kind + content)))

    lines = b"".join(b"\0" + row.tobytes() for row in grey)
    png = (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", columns, rows, 8, 0, 0, 0, 0))
           + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))
    (dx, dy), (nx, ny) = surface.spacing, surface.nodes
    return (f'<figure style="display:inline-block;margin:4px"><img width="240" alt="heights" '
            f'src="data:image/png;base64,{base64.b64encode(png).decode()}"><figcaption>height, {low:.3g} to '
            f"{high:.3g} mm, over {nx * dx:.4g} x {ny * dy:.4g} mm</figcaption></figure>")


def _curve_picture(curve):
    return _picture(curve.pressure, curve.tangent_stiffness,
                    f"stiffness, {curve.tangent_stiffness[0]:.3g} to {curve.tangent_stiffness[-1]:.3g} MPa/mm, "
                    f"to {curve.pressure[-1]:.3g} MPa")


def _design_box(design):
    worst = design.similarity_worst
    verdict = ("found" if design.found else "; ".join(design.out_of_reach)
               or ("not verified" if worst is None else "not found"))
    worst = "none" if worst is None else f"{worst:.4f}"
    return (f'<div style="border:1px solid #888;padding:8px"><b>{escape(verdict)}</b>: similarity '
            f"{worst} (lowest), {design.similarity:.4f} on the grid of the design<br>"
            f"{design.profile._repr_html_()}{_curve_picture(design.curve)}</div>")


def attach(curve, profile, surface, design):
    """Adds the pictures to the classes of the module."""
    curve.plot, curve._repr_html_ = _plot_curve, _curve_picture
    profile.plot, profile._repr_html_ = _plot_profile, _profile_picture
    surface.plot, surface._repr_html_ = _plot_surface, _surface_picture
    design.plot, design._repr_html_ = _plot_design, _design_box
