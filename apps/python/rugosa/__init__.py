"""Rough profiles with a given contact behaviour.

Lengths are in mm, pressures in MPa, stiffness in MPa/mm, angles in rad. `contact` presses a surface on an
elastic body, `design` finds one that answers as asked, `optimise` is the genetic-algorithm engine for a problem
of one's own.

>>> import numpy, rugosa
>>> x = (numpy.arange(512) - 255.5) / 512
>>> rugosa.contact(-x**2 / 2, 1 / 512)
<rugosa.Curve of 20 load steps to 0.0850725555 MPa>
"""

import pathlib as _pathlib

from . import _show
from ._rugosa import (Answer, Curve, Database, Design, Genome, InputError, NotConverged, Optimisation, Profile,
                      Search, Stored, Surface, Target, UsageError, __version__, contact, design, optimise,
                      read_profile, read_surface, search)

__all__ = ["Answer", "Curve", "Database", "Design", "Genome", "InputError", "NotConverged", "Optimisation",
           "Profile", "Search", "Stored", "Surface", "Target", "UsageError", "contact", "design", "optimise",
           "read", "search"]


def read(file, *, surface=False, **options):
    """A genome file (.json) as a Genome, a measured scan as a Profile, or a map as a Surface.

    Options of a scan as the program's flags: unit, spacing, row, detrend, outliers, lambda_s, lambda_c, fill.
    With surface=True, or a spacing that is a pair along x and y, the file is a map; it has spacing, unit and
    detrend.
    """
    if _pathlib.Path(file).suffix == ".json":
        if options:
            raise TypeError(f"read: {next(iter(options))} given with a genome file, expected with a scan only")
        return Genome.read(file)
    if surface or isinstance(options.get("spacing"), (tuple, list)):
        return read_surface(file, **options)
    return read_profile(file, **options)[0]


InputError.__doc__ = "What was given cannot be used: one line says what, and what was expected."
NotConverged.__doc__ = "A solver ended without an answer that its certificate bears out."
UsageError.__doc__ = "A pipeline cannot work: one line says where and why."
_show.attach(Curve, Profile, Surface, Design)
