"""Tables as CSV text: UTF-8, full precision, a heading with units."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Sequence


def write_csv(
    headings: Sequence[str], rows: Iterable[Sequence[float | str | None]]
) -> bytes:
    """CSV of rows under headings; a missing number is an empty cell.

    >>> write_csv(["a_m", "b"], [[0.5, None], [1.0, "x"]])
    b'a_m,b\\n0.5,\\n1.0,x\\n'
    """
    buffer = io.StringIO()
    writer = csv.writer(buffer, lineterminator="\n")
    writer.writerow(headings)
    writer.writerows(rows)
    return buffer.getvalue().encode()
