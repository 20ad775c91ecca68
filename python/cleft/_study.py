"""The cases of a study, and fields between them."""

import os
import warnings
from collections.abc import Mapping
from typing import Any, Iterator, Optional, Union

import numpy as np

from . import _cleft
from ._arrays import table_of
from ._cleft import BlendedField, Field, InputError, Snapshot


class Study:
    """The published cases of a study folder, a study.dffd or a case.dffd; case numbers count from 0.

    Opening reads the parameters of all cases, and no coefficients: 1,000 cases of a study.dffd in some 10 ms. A case is
    decoded when it is asked for; the last 16 are kept.
    """

    def __init__(self, path: Union[str, os.PathLike]):
        self._study = _cleft.Study(os.fspath(path))
        self._known: Optional[np.ndarray] = None
        self._opening: dict = {}

    def __repr__(self) -> str:
        return f"<cleft.Study {self.path}: {len(self)} cases, varying {', '.join(self._study.varying) or 'nothing'}>"

    def __len__(self) -> int:
        return len(self._study)

    def __iter__(self) -> Iterator[Field]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, case: Union[int, str]) -> Field:
        """The field of a case by its number (-1: the last one) or its hash."""
        return self._study.field(self._number(case))

    def _number(self, case: Union[int, str]) -> int:
        if not isinstance(case, str):
            return case + len(self) if case < 0 else case
        found = [i for i in range(len(self)) if self._study.hash(i).startswith(case)]
        if len(found) != 1 or not case:
            raise InputError(f"case '{case}': {len(found)} cases of {self.path} have a hash that begins so")
        return found[0]

    @property
    def path(self) -> str:
        """As given."""
        return self._study.path

    @property
    def older(self) -> list:
        """Cases that were left out because their fields have an older format."""
        return self._study.older

    @property
    def damaged(self) -> list:
        """Cases that were left out because their field or manifest is gone or damaged."""
        return self._study.damaged

    @property
    def _values(self) -> np.ndarray:
        """(cases, varying)"""
        if self._known is None:
            names = self._study.varying
            rows = [self._study.parameters(i) for i in range(len(self))]
            self._known = np.array([[row.get(name, np.nan) for name in names] for row in rows]).reshape(len(rows), len(names))
        return self._known

    @property
    def varying(self) -> dict:
        """(least, greatest) of the parameters in which the cases differ, by dotted name."""
        values = self._values
        return {name: (values[:, k].min(), values[:, k].max()) for k, name in enumerate(self._study.varying)}

    @property
    def cases(self) -> Any:
        """A row for each case: its hash (as in `cleft status`), the parameters that vary, the largest displacement (mm)
        and the fit's largest error at any node and frame, relative to it. A pandas DataFrame where pandas is installed,
        else a structured array."""
        reports = [self._study.report(i) for i in range(len(self))]
        columns = {"hash": [self._study.hash(i) for i in range(len(self))]}
        columns.update((name, self._values[:, k]) for k, name in enumerate(self._study.varying))
        for name in ("largest_displacement", "node_error"):
            columns[name] = np.array([report[name] for report in reports])
        return table_of(columns)

    def parameters(self, case: Union[int, str]) -> dict:
        """All parameters of a case by dotted name, switches and choices as text."""
        return self._study.parameters(self._number(case))

    def snapshot(self, case: Union[int, str]) -> Snapshot:
        """The simulation of a case, where the study has kept it."""
        return Snapshot(self._study.snapshot(self._number(case)))

    def sel(self, values: Optional[Mapping] = None, **keywords: float) -> Field:
        """The field for these parameters: that of a simulated case, or else one between the cases.

        Names are dotted in a mapping, and have underscores as keywords: sel({"skin.prestress_v": 0.03}) and
        sel(skin_prestress_v=0.03). Every parameter in which the cases differ is needed. field.estimated_error tells how far
        the field is expected to be from a simulation; outside of the cases, where that is a guess, there is a warning.
        """
        given = self._given(values, keywords)
        case = self._simulated(given)
        return self._study.field(case) if case is not None else self.interpolate(given)

    def interpolate(self, values: Optional[Mapping] = None, **keywords: float) -> Field:
        """As sel(), but always between the cases, as `cleft interpolate` does. The first call reads all cases."""
        field = self._study.interpolated(self._given(values, keywords))
        if field.outside > 0:
            warnings.warn(f"these parameters lie outside the study, by {field.outside:.3g} of its spread; the estimated "
                          "error is a guess there", stacklevel=2)
        return field

    def find(self, where: str) -> Any:
        """The cases, lengths cut (t) and places along the cut (u), mm, at which a condition of `cleft find` holds, like
        "gape > 3 and tissue.young_modulus < 0.01": a table with a row for each case. confirmed: by the nodes of the
        simulation, or None where that is not kept."""
        names = ("case", "hash", "first_t", "last_t", "least_u", "greatest_u", "gape", "at_t", "at_u", "confirmed")
        rows = self._study.found(where)
        return table_of({name: [row[name] for row in rows] for name in names})

    @staticmethod
    def _given(values: Optional[Mapping], keywords: Mapping) -> dict:
        given: dict = {}
        for word, value in [*(values or {}).items(), *keywords.items()]:
            name = _cleft.parameter_of_keyword(word)
            if name in given:
                raise InputError(f"sel: {name}: given twice")
            given[name] = float(value)
        return given

    def _simulated(self, given: Mapping) -> Optional[int]:
        names = self._study.varying
        if any(name not in given for name in names):
            return None
        constant = self._study.parameters(0)
        if any(name not in names and constant.get(name) != value for name, value in given.items()):
            return None
        wanted = np.array([given[name] for name in names])
        same = np.flatnonzero(np.all(np.isclose(self._values, wanted, rtol=1e-9, atol=0), axis=1))
        return int(same[0]) if len(same) else None

    def _file(self) -> str:
        """The study.dffd, for commands that take files."""
        return os.path.join(self.path, "study.dffd") if os.path.isdir(self.path) else self.path


def open(path: Union[str, os.PathLike]) -> Union[Study, Field, BlendedField, Snapshot]:
    """A Study for a study folder or a study.dffd, a Field for a case.dffd (a BlendedField for one with several breaks), a
    Snapshot for a case.h5."""
    path = os.fspath(path)
    kind = _cleft.format_of(path)
    if kind == "cleft-field":
        return _cleft.read_blended(path) if _cleft.pieces_in(path) > 0 else _cleft.read_field(path)
    return Snapshot(path) if kind == "cleft-snapshot" else Study(path)


def find(study: Union[Study, str, os.PathLike], where: str) -> Any:
    """Study.find() of a study or of its path."""
    return (study if isinstance(study, Study) else Study(study)).find(where)


def interpolate(study: Union[Study, str, os.PathLike], values: Mapping, out: Optional[str] = None) -> Field:
    """Study.interpolate() of a study or of its path; `out`: a case.dffd to write."""
    field = (study if isinstance(study, Study) else Study(study)).interpolate(values)
    if out is not None:
        field.save(os.fspath(out))
    return field
