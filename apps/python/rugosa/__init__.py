"""Rough profiles with a given contact behaviour.

Lengths are in mm, pressures in MPa, stiffness in MPa/mm, angles in rad. `contact` presses a surface on an
elastic body, `design` finds one with a target's response, and `optimise` runs the genetic-algorithm engine on your
problem.

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

    The options are the program's flags: unit, spacing, row, detrend, outliers, lambda_s, lambda_c, fill and
    max_filled of a scan; a map has no row. The file is a map with surface=True, or if spacing is a pair along x
    and y.
    """
    if _pathlib.Path(file).suffix == ".json":
        if options:
            raise TypeError(f"read: {next(iter(options))} is only for scans; leave it out for a genome file")
        return Genome.read(file)
    if surface or isinstance(options.get("spacing"), (tuple, list)):
        return read_surface(file, **options)
    return read_profile(file, **options)[0]


InputError.__doc__ = "An argument or file cannot be used. The message says where, why, and what to do."
NotConverged.__doc__ = "A solver ended without a certified solution."
UsageError.__doc__ = "A pipeline cannot work. The message says where and why."
_show.attach(Curve, Profile, Surface, Design)
