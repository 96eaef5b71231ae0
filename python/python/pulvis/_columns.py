"""Named arrays of one shape."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pandas


class Columns(Mapping[str, "NDArray[Any]"]):
    """Arrays by their names, which are those of the command's tables: ``columns["force"]`` or ``columns.force``.

    Of a column with a dotted name the last part will do: ``columns.kc`` for ``contact.normal.kc``. Quantities are in SI
    units. What does not exist is NaN, of words the empty one.
    """

    def __init__(self, columns: Mapping[str, NDArray[Any]]) -> None:
        self._columns = dict(columns)

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name in self._columns:
            return self._columns[name]
        ending = [column for column in self._columns if column.rsplit(".", 1)[-1] == name]
        if len(ending) == 1:
            return self._columns[ending[0]]
        raise KeyError(name)

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __getattr__(self, name: str) -> NDArray[Any]:
        if not name.startswith("_"):
            try:
                return self[name]
            except KeyError:
                pass
        raise AttributeError(f"no column `{name}`; there are {', '.join(self.__dict__.get('_columns', ()))}")

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *(name.rsplit(".", 1)[-1] for name in self._columns)]

    def __repr__(self) -> str:
        shape = next((column.shape for column in self._columns.values()), ())
        return f"{type(self).__name__} of shape {shape}: {', '.join(self._columns)}"

    def to_dataframe(self) -> pandas.DataFrame:
        """The columns as a table of pandas, one row for each element; vectors become one column for each component.

        Raises
        ------
        ImportError
            pandas is not installed.
        """
        import pandas

        flat: dict[str, NDArray[Any]] = {}
        size = max((column.shape[0] if column.ndim else 1 for column in self._columns.values()), default=0)
        for name, column in self._columns.items():
            if self._is_vector(column):
                for axis, letter in enumerate("xyz"):
                    flat[f"{name}_{letter}"] = column[:, axis]
            else:
                flat[name] = column.ravel() if column.ndim else np.full(max(size, 1), column)
        return pandas.DataFrame(flat)

    def to_structured(self) -> NDArray[Any]:
        """The columns as one structured array of numpy, one element a row; vectors are fields of three numbers."""
        rows = {name: column.reshape(-1) if not self._is_vector(column) else column for name, column in self.items()}
        fields = [(name, column.dtype, column.shape[1:]) for name, column in rows.items()]
        size = max((len(column) for column in rows.values()), default=0)
        array = np.empty(size, dtype=fields)
        for name, column in rows.items():
            array[name] = column
        return array

    def _is_vector(self, column: NDArray[Any]) -> bool:
        others = (other.ndim for other in self._columns.values())
        return column.ndim == 2 and column.shape[1] == 3 and min(others) == 1


def from_native(columns: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
    """Columns as the compiled part gives them: words are a list and indices into it."""
    out: dict[str, NDArray[Any]] = {}
    for name, column in columns.items():
        if isinstance(column, tuple):
            words, indices = column
            out[name] = np.asarray(words or [""], dtype=np.str_)[indices]
        else:
            out[name] = column
    return out
