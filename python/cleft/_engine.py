"""xarray.open_dataset("study.dffd", engine="cleft"): the displacements of a study, evaluated when they are asked for."""

import os

import numpy as np
from xarray.backends import BackendArray, BackendEntrypoint
from xarray.core import indexing
from xarray import Dataset, Variable

from ._cleft import InputError
from ._study import Study


def _skin(field, along=61, across=20):
    """(N, 4): u, v, w and side of a grid over the skin, with both lips on v = 0."""
    u = np.linspace(*field.domain["u"], along)
    least, greatest = field.domain["v"]
    left = np.linspace(least, 0, across + 1)
    right = np.linspace(0, greatest, across + 1)
    rows = [(v, side) for v, side in zip(left, [0] * across + [-1])] + [(v, side) for v, side in zip(right, [1] + [0] * across)]
    return np.array([(x, v, 0.0, side) for v, side in rows for x in u])


def _grid(study):
    """Names and values of the dimensions of the cases, and the case at each place: the parameters that vary where the cases
    are all of their combinations, else the case's number."""
    names, values = list(study.varying), study._values
    axes = [np.unique(column) for column in values.T]
    if not names or np.prod([len(axis) for axis in axes]) != len(study) or len(np.unique(values, axis=0)) != len(study):
        return {"case": np.arange(len(study))}, np.arange(len(study))
    numbers = np.empty([len(axis) for axis in axes], dtype=int)
    numbers[tuple(np.searchsorted(axis, column) for axis, column in zip(axes, values.T))] = np.arange(len(study))
    return {name.replace(".", "_"): axis for name, axis in zip(names, axes)}, numbers


class _Displacements(BackendArray):
    def __init__(self, study, numbers, places, times):
        self.study, self.numbers, self.places, self.times = study, numbers, places, times
        self.shape = (*numbers.shape, len(times), len(places), 3)
        self.dtype = np.dtype(float)

    def __getitem__(self, key):
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER, self._values)

    def _values(self, key):
        chosen = [np.arange(extent)[index] for extent, index in zip(self.shape, key)]
        kept = tuple(0 if one.ndim == 0 else slice(None) for one in chosen)
        cases, times, points, components = chosen[:-3], *(np.atleast_1d(one) for one in chosen[-3:])
        numbers = self.numbers[np.ix_(*(np.atleast_1d(one) for one in cases))]
        u, v, w, side = self.places[points].T
        result = np.empty((numbers.size, len(times), len(points), len(components)))
        for row, case in zip(result, numbers.ravel()):
            field = self.study[int(case)]
            t = np.minimum(self.times[times], field.duration)[:, None]
            row[:] = field(u, v, w, t, side, threads=0, outside="clamp")[..., components]
        return result.reshape(*numbers.shape, *result.shape[1:])[kept]


class CleftBackend(BackendEntrypoint):
    """displacement (mm) over the study's parameters (where the cases are all of their combinations; else over case), t, point
    and component. points: (N, 4) array of u, v, w, side; by default a grid over the skin. times: lengths cut, mm, or their
    number over the longest cut; a case that is complete stays so. A point outside of a case's domain is taken as the nearest
    inside."""

    description = "Open study.dffd, case.dffd and study folders of Cleft"

    def open_dataset(self, filename_or_obj, *, drop_variables=None, points=None, times=21):
        study = Study(filename_or_obj)
        first = study[0]
        places = _skin(first) if points is None else np.asarray(points, dtype=float)
        if places.ndim != 2 or places.shape[1] != 4:
            raise InputError(f"points: an array of shape (N, 4) is needed, u, v, w, side, not {places.shape}")
        if np.ndim(times) == 0:
            lengths = [study.parameters(i).get("cut.length", first.duration) for i in range(len(study))]
            longest = first.duration if "cut.length" not in study.varying else max(lengths)
            times = np.linspace(0, longest, int(times))
        times = np.asarray(times, dtype=float)
        axes, numbers = _grid(study)
        values = indexing.LazilyIndexedArray(_Displacements(study, numbers, places, times))
        reports = [study._study.report(i) for i in range(len(study))]

        def of_cases(items):
            return tuple(axes), np.array(items)[numbers]

        variables = {"displacement": Variable((*axes, "t", "point", "component"), values, {"units": "mm"}),
                     "hash": Variable(*of_cases([study._study.hash(i) for i in range(len(study))])),
                     "node_error": Variable(*of_cases([report["node_error"] for report in reports]))}
        coordinates = {**{name: (name, axis) for name, axis in axes.items()},
                       "t": ("t", times, {"units": "mm"}), "component": ["du", "dv", "dw"],
                       **{name: ("point", places[:, k], {"units": "mm"} if k < 3 else {}) for k, name in
                          enumerate(("u", "v", "w", "side"))}}
        if "case" in axes:
            coordinates.update((name.replace(".", "_"), ("case", study._values[:, k])) for k, name in enumerate(study.varying))
        for name in drop_variables or ():
            variables.pop(name, None)
        return Dataset(variables, coordinates, {"source": study.path})

    def guess_can_open(self, filename_or_obj):
        return isinstance(filename_or_obj, (str, os.PathLike)) and os.fspath(filename_or_obj).endswith(".dffd")
