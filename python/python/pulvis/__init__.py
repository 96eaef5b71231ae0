"""Pulvis: a discrete element method engine for adhesive, elasto-plastic powders.

Laws and pair contacts:
    :func:`laws`, :func:`law`, :func:`tabulated`, :func:`contact`, :func:`probe`, :func:`collide`,
    :class:`PythonLaw`
Many bodies:
    :class:`Simulation` (step by step), :func:`run`, :func:`resume` and :class:`Run` (with files), :func:`study` (many runs)

All quantities are in SI units. Where a number is expected, a text with a unit will do: ``"100 N/m"``.
"""

from ._columns import Columns
from ._native import __version__
from .collision import Collisions, collide
from .curves import tabulated
from .errors import InputError, InternalError, PulvisError, RunError, ViewError
from .laws import Contact, Law, LawEntry, Parameter, contact, law, laws
from .probing import ProbeCurve, probe
from .pythonlaw import PythonLaw
from .runs import Run, resume, run
from .particles import Particles
from .scenarios import StageEnd
from .simulation import Simulation
from .studies import Case, Study, study
from .walls import Wall

__all__ = [
    "Case",
    "Collisions",
    "Columns",
    "Contact",
    "InputError",
    "InternalError",
    "Law",
    "LawEntry",
    "Parameter",
    "Particles",
    "ProbeCurve",
    "PulvisError",
    "PythonLaw",
    "Run",
    "RunError",
    "Simulation",
    "StageEnd",
    "Study",
    "ViewError",
    "Wall",
    "__version__",
    "collide",
    "contact",
    "law",
    "laws",
    "probe",
    "resume",
    "run",
    "study",
    "tabulated",
]
