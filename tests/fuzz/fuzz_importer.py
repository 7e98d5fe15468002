"""Coverage-guided fuzzing of the importer, with atheris (Linux; no test needs it).

Bytes become a csv file, or the XML of one sheet of a sound workbook. What may end how
is said in `targets`::

    pip install atheris
    python tests/fuzz/fuzz_importer.py -max_total_time=120 -max_len=4000
"""

from __future__ import annotations

import io
import sys
import zipfile
from pathlib import Path

import pytest

atheris = pytest.importorskip("atheris")  # pytest looks at every module for examples

sys.path.insert(0, str(Path(__file__).parent.parent.parent))
with atheris.instrument_imports(
    include=["netdesign.site", "netdesign.edge.given_files"]
):
    from tests.fuzz import targets

_SHEETS = sorted(n for n in targets.sound_parts() if n.startswith("xl/worksheets/s"))


def put_into_workbook(content: bytes, sheet: str) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for name, sound in targets.sound_parts().items():
            archive.writestr(name, content if name == sheet else sound)
    return buffer.getvalue()


def try_one(content: bytes) -> None:
    if not content:
        return
    with targets.time_limit():
        if content[0] < ord("<"):
            sheet = _SHEETS[content[0] % len(_SHEETS)]
            targets.read_content("site.xlsx", put_into_workbook(content[1:], sheet))
        else:
            targets.read_content("site.csv", content)


def write_seeds() -> Path:
    """Sound inputs of both kinds, for the fuzzer to start from."""
    folder = targets.scratch() / "seeds"
    folder.mkdir()
    (folder / "csv").write_bytes(
        targets.write_delimited(targets.example_tables()["Nets"])
    )
    for number, sheet in enumerate(_SHEETS):
        (folder / f"sheet-{number}").write_bytes(
            bytes([number]) + targets.sound_parts()[sheet]
        )
    return folder


if __name__ == "__main__":
    atheris.Setup([*sys.argv, str(write_seeds())], try_one)
    atheris.Fuzz()
