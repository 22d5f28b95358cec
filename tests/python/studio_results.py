# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of two runs, compared bit by bit, for the tests. Imported, it ends the test with 77 when h5py is
missing."""

import sys

try:
    import h5py
    import numpy as np
except ImportError as problem:
    print("SKIPPED:", problem)
    sys.exit(77)


def same_results(a, b):
    """The number of datasets of results.h5, which are the same bits, as is history.csv."""
    assert (a / "history.csv").read_bytes() == (b / "history.csv").read_bytes(), "history.csv differs"
    found = []
    with h5py.File(a / "results.h5") as one, h5py.File(b / "results.h5") as other:
        def compare(name, data):
            if isinstance(data, h5py.Dataset):
                assert data.dtype == other[name].dtype and data.shape == other[name].shape, name
                assert data.dtype.hasobject or data[()].tobytes() == other[name][()].tobytes(), name
                assert not data.dtype.hasobject or np.array_equal(data[()], other[name][()]), name
                found.append(name)
        one.visititems(compare)
        names = []
        other.visititems(lambda name, data: names.append(name) if isinstance(data, h5py.Dataset) else None)
    assert found == names and len(found) > 100, len(found)
    return len(found)
