"""Docent's library for Python: maps, logs, localization, planning, mapping, recordings, simulated runs.

Names are those of C++, where the headers in include/docent say more. SI units, angles in radians unless a name says degrees;
`map_from_robot` takes robot coordinates to map coordinates. Arrays of cells are [rows, columns], row 0 the lowest. What
cannot be done raises `docent.Error`, what cannot be an argument TypeError or ValueError.
"""
from ._error import Error
from ._docent import *  # noqa: F403
from . import _docent
from ._simulation import Simulation, find_program, simulate

__all__ = ["Error", "Simulation", "find_program", "simulate",
           *(name for name in vars(_docent) if not name.startswith("_"))]
