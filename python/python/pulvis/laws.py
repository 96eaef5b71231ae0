"""Contact laws: the catalogue, laws with parameters, and contacts made of them."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any, Union

import numpy as np
from numpy.typing import ArrayLike

from . import _native, _toml
from .errors import InputError

if TYPE_CHECKING:
    from .collision import Collisions
    from .probing import ProbeCurve

__all__ = ["Contact", "Law", "LawEntry", "Parameter", "contact", "law", "laws"]

#: Roles whose tables name no law.
_UNNAMED = ("conventions", "expected")

#: What a parameter may be: a number in SI, a text with its unit, a choice, or an array of numbers to be swept.
ParameterValue = Union[float, str, ArrayLike, tuple[Any, ...]]


@dataclass(frozen=True)
class Parameter:
    """One parameter of a law, or a quantity of particles that it reads."""

    name: str
    symbol: str
    unit: str
    allowed: str
    default: str
    meaning: str
    required: bool
    choices: tuple[tuple[str, str], ...] | None
    is_list: bool


class LawEntry:
    """A law of the catalogue; calling it with parameters makes a :class:`Law`. ``help(entry)`` describes it.

    Attributes
    ----------
    role, name, summary, equations, source, closed_form, example : str
        As ``pulvis laws NAME`` prints them.
    memory : tuple of str
        What a contact remembers.
    parameters, particle_quantities : tuple of Parameter
    """

    def __init__(self, described: Mapping[str, Any]) -> None:
        self.role: str = described["role"]
        self.name: str = described["name"]
        self.summary: str = described["summary"]
        self.equations: str = described["equations"]
        self.source: str = described["source"]
        self.closed_form: str = described["closed_form"]
        self.example: str = described["example"]
        self.memory: tuple[str, ...] = tuple(described["memory"])
        self.parameters = _parameters(described["parameters"])
        self.particle_quantities = _parameters(described["particle_quantities"])
        self.__doc__ = _describe(self)
        kind = inspect.Parameter.KEYWORD_ONLY
        self.__signature__ = inspect.Signature(
            [
                inspect.Parameter(p.name, kind, default=inspect.Parameter.empty if p.required else p.default)
                for p in self.parameters
            ],
            return_annotation=Law,
        )

    def __call__(self, **parameters: ParameterValue) -> Law:
        return Law(self, parameters)

    def __repr__(self) -> str:
        return f"<{self.role} law {self.name}: {self.summary}>"


def _parameters(described: list[dict[str, Any]]) -> tuple[Parameter, ...]:
    def one(d: dict[str, Any]) -> Parameter:
        choices = None if d["choices"] is None else tuple(map(tuple, d["choices"]))
        return Parameter(**{**d, "choices": choices})

    return tuple(one(d) for d in described)


def _describe(entry: LawEntry) -> str:
    """A docstring after the rules of numpydoc."""

    def indented(text: str) -> str:
        return "\n".join(f"    {line}".rstrip() for line in text.splitlines())

    def section(title: str, body: str) -> str:
        return f"{title}\n{'-' * len(title)}\n{body}\n"

    def listed(parameters: tuple[Parameter, ...]) -> str:
        lines = []
        for p in parameters:
            lines.append(f"{p.name} : {p.unit}, {p.allowed}; {p.default}")
            lines.append(f"    {p.symbol}: {p.meaning}" if p.symbol else f"    {p.meaning}")
            lines.extend(f"    ``\"{name}\"``: {meaning}" for name, meaning in p.choices or ())
        return "\n".join(lines)

    parts = [f"{entry.name} ({entry.role} law): {entry.summary}\n"]
    if entry.parameters:
        parts.append(section("Parameters", listed(entry.parameters)))
    if entry.particle_quantities:
        parts.append(section("Reads of each particle", listed(entry.particle_quantities)))
    parts.append(section("Notes", indented(entry.equations)))
    parts.append(section("Verified against", indented(entry.closed_form)))
    parts.append(section("References", indented(entry.source)))
    return "\n".join(parts)


@lru_cache(maxsize=1)
def _catalogue() -> tuple[LawEntry, ...]:
    return tuple(LawEntry(described) for described in _native.catalogue())


def laws(role: str | None = None) -> list[LawEntry]:
    """The laws of the catalogue.

    Parameters
    ----------
    role : str, optional
        Only those of this role: ``normal``, ``noncontact``, ``viscosity``, ``sliding``, ``rolling``, ``torsion``,
        ``bond``, ``conventions`` or ``expected``.

    Returns
    -------
    list of LawEntry

    Examples
    --------
    >>> import pulvis
    >>> "luding" in [entry.name for entry in pulvis.laws("normal")]
    True
    """
    roles = list(dict.fromkeys(entry.role for entry in _catalogue()))
    if role is not None and role not in roles:
        raise InputError(f"no role is called {role!r}; there are {', '.join(roles)}", key="role")
    return [entry for entry in _catalogue() if role is None or entry.role == role]


def _entry(name: str, role: str | None) -> LawEntry:
    import difflib

    entries = laws(role)
    for entry in entries:
        if entry.name == name:
            return entry
    names = list(dict.fromkeys(entry.name for entry in entries))
    similar = difflib.get_close_matches(name, names, 1)
    hint = f"; did you mean {similar[0]!r}?" if similar else ""
    whose = f" of the role {role!r}" if role else ""
    raise InputError(f"no law{whose} is called {name!r}; there are {', '.join(names)}{hint}", key="law")


def law(name: str, /, *, role: str | None = None, **parameters: ParameterValue) -> Law:
    """A law with its parameters.

    Parameters
    ----------
    name : str
        Its name in the catalogue, such as ``"luding"``.
    role : str, optional
        Of a law that plays several roles, the role; the first one if it is left out.
    **parameters
        Numbers in SI units, texts with units (``"100 N/m"``), or arrays of numbers in SI units, over which
        :func:`pulvis.collide` sweeps.

    Returns
    -------
    Law

    Raises
    ------
    InputError
        A parameter is missing, unknown or out of range, or parameters do not fit together; ``key`` names it.

    Examples
    --------
    >>> import pulvis
    >>> luding = pulvis.law("luding", k1="100 N/m", kp=500, kc=100, phi_f=0.05)
    >>> luding
    law('luding', k1='100 N/m', kp=500, kc=100, phi_f=0.05)
    """
    return Law(_entry(name, role), parameters)


class Law:
    """A law of the catalogue with its parameters; made by :func:`law`."""

    def __init__(self, entry: LawEntry, parameters: Mapping[str, ParameterValue]) -> None:
        self.entry = entry
        lists = {parameter.name for parameter in entry.parameters if parameter.is_list}
        self.parameters: dict[str, ParameterValue] = {
            name: _items(name, value) if name in lists else value
            for name, value in parameters.items()
            if value is not None
        }
        single = {name: _first(value) for name, value in self.parameters.items()}
        _native.check_law(entry.role, entry.name, _toml.dumps(single))

    @property
    def name(self) -> str:
        """Its name in the catalogue."""
        return self.entry.name

    @property
    def role(self) -> str:
        """Which part of a contact it is."""
        return self.entry.role

    def table(self) -> dict[str, Any]:
        """The law as the table of a scenario."""
        named = {} if self.role in _UNNAMED else {"law": self.name}
        return {**named, **self.parameters}

    def in_role(self, role: str) -> Law:
        """The same law in another role."""
        return self if role == self.role else Law(_entry(self.name, role), self.parameters)

    def replace(self, **parameters: ParameterValue) -> Law:
        """The same law with other parameters."""
        return Law(self.entry, {**self.parameters, **parameters})

    def probe(self, **arguments: Any) -> ProbeCurve:
        """See :func:`pulvis.probe`."""
        return Contact([self]).probe(**arguments)

    def collide(self, **arguments: Any) -> Collisions:
        """See :func:`pulvis.collide`."""
        return Contact([self]).collide(**arguments)

    def __repr__(self) -> str:
        def shown(value: Any) -> str:
            return f"<{len(value)} values>" if isinstance(value, tuple) and len(value) > 4 else repr(value)

        given = "".join(f", {name}={shown(value)}" for name, value in self.parameters.items())
        return f"law({self.name!r}{given})"


def _items(name: str, value: Any) -> tuple[Any, ...]:
    """The items of a parameter that is a list: a tuple, which is not swept over."""
    try:
        return tuple(item if isinstance(item, str) else float(item) for item in value)
    except (TypeError, ValueError):
        text = f"{name}: found {value!r}, expected a list of numbers in SI units or texts with units"
        raise InputError(text, key=name) from None


def _first(value: ParameterValue) -> Any:
    """The first element of an array; a tuple is a list that belongs together."""
    if isinstance(value, (str, tuple)) or np.ndim(value) == 0:
        return value
    array = np.asarray(value)
    if array.size == 0:
        raise InputError("an array of parameters is empty")
    return array.flat[0]


class Contact:
    """All laws of one contact; made by :func:`contact`."""

    def __init__(self, laws: list[Law]) -> None:
        self.laws: dict[str, Law] = {}
        for one in laws:
            if one.role in self.laws:
                raise InputError(f"two laws of the role {one.role!r}: {self.laws[one.role]!r} and {one!r}")
            self.laws[one.role] = one

    def tables(self) -> dict[str, Any]:
        """The contact as the table of a scenario."""
        return {role: one.table() for role, one in self.laws.items()}

    def probe(self, **arguments: Any) -> ProbeCurve:
        """See :func:`pulvis.probe`."""
        from .probing import probe

        return probe(self, **arguments)

    def collide(self, **arguments: Any) -> Collisions:
        """See :func:`pulvis.collide`."""
        from .collision import collide

        return collide(self, **arguments)

    def __iter__(self) -> Iterator[Law]:
        return iter(self.laws.values())

    def __repr__(self) -> str:
        return f"contact({', '.join(repr(one) for one in self)})"


def contact(*laws: Law, **by_role: Law) -> Contact:
    """A contact of several laws.

    Parameters
    ----------
    *laws : Law
        Laws in their own roles.
    **by_role : Law
        Laws by their roles: ``viscosity=``, ``sliding=``, and so on.

    Returns
    -------
    Contact

    Examples
    --------
    >>> import pulvis
    >>> hertz = pulvis.law("hertz", effective_modulus="1 GPa")
    >>> slider = pulvis.law("mindlin", effective_shear_modulus="0.5 GPa", mu=0.3)
    >>> list(pulvis.contact(hertz, sliding=slider).laws)
    ['normal', 'sliding']
    """
    return Contact([*laws, *(one.in_role(role) for role, one in by_role.items())])


def as_contact(one: Law | Contact) -> Contact:
    """A law alone is a contact without friction."""
    if isinstance(one, Contact):
        return one
    if isinstance(one, Law):
        return Contact([one])
    raise InputError(f"expected a law or a contact, found {type(one).__name__}")
