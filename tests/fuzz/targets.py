"""What is fuzzed: inputs made from sound ones and from noise, and how each may end."""

from __future__ import annotations

import contextlib
import copy
import io
import json
import math
import shutil
import signal
import sqlite3
import sys
import tempfile
import tomllib
import zipfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
import xlsxwriter
from hypothesis import strategies as st

from netdesign import cli
from netdesign.checks import load_standard
from netdesign.coupling.solution import FailedSolution
from netdesign.edge.input_files import find_resource
from netdesign.files.scene import read_scene
from netdesign.outcome import NetDesignError, Outcome, SiteDataError
from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.columns.office import TABLES, load_plan
from netdesign.site.reader import read_site
from netdesign.site.template.annotate import annotate_workbook
from netdesign.site.template.example import write_site_workbook
from netdesign.solving.store import CaseStore, StoreError
from netdesign.study.document import read_document, write_document
from netdesign.words.message import say
from tests.full_scene import FULL_SCENE
from tests.report.build_study import build_study

SECONDS = 20  # for one input; a hang ends as a find
_REFUSED = 3

# --- what ends soundly ---------------------------------------------------------------


class HungError(BaseException):
    """An input took longer than any may; nothing in the program catches it."""


@contextlib.contextmanager
def time_limit() -> Iterator[None]:
    def stop(*_: object) -> None:
        raise HungError

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)


def is_shown_only(text: str) -> bool:
    return all(sign.isprintable() or sign in "\n\u00a0" for sign in text)


def attempt(read: Callable[[], Any]) -> Any:
    """What ``read`` gives, or the error by which it refuses its input."""
    try:
        found = read()
    except NetDesignError as refusal:
        found = refusal
    if not isinstance(found, NetDesignError):
        assert_finite(found)
        return found
    message = str(found)
    assert found.exit_code == _REFUSED, message
    assert message.strip()
    assert len(message) < 200_000
    # the command line prints findings as they are, all else without such signs
    assert is_shown_only(message) or not isinstance(found, SiteDataError)
    return found


# Where infinity means "none is given", or "and more".
_MAY_BE_INFINITE = {"gap", "rows"}


def assert_finite(value: Any, name: str = "") -> None:
    if is_dataclass(value) and not isinstance(value, type):
        for field in fields(value):
            assert_finite(getattr(value, field.name), field.name)
    elif isinstance(value, list | tuple):
        for one in value:
            assert_finite(one, name)
    elif isinstance(value, float):
        assert not math.isnan(value), name
        assert math.isfinite(value) or name in _MAY_BE_INFINITE, name


def run_main(folder: Path, arguments: list[str]) -> tuple[int, str, str]:
    """Exit code, output and errors of the program, called as from a shell."""
    out, err = io.StringIO(), io.StringIO()
    with (
        contextlib.chdir(folder),
        patch.object(sys, "argv", ["netdesign", *arguments]),
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
    ):
        try:
            cli.main()
        except SystemExit as end:
            code = end.code
    return int(code or 0), out.getvalue(), err.getvalue()


# --- what is drawn -------------------------------------------------------------------

SIGNS = st.text(max_size=12)
NUMBERS = st.one_of(
    st.floats(),
    st.integers(),
    st.integers(min_value=-(10**400), max_value=10**400),
    st.sampled_from([0, -0.0, 1e308, 5e-324, 2**63, 10**4000 // 7]),
)
WRITTEN = st.one_of(
    st.floats().map(repr),
    st.floats(-1e6, 1e6).map(lambda x: f"{x:.3f}".replace(".", ",")),
    st.sampled_from(
        [
            *("1.234,5", "1'000", "1 000,5", "1,234", "1e999", "-1e-999", "nan", "inf"),
            *("١٢", "½", "²", "0x10", "1_000", "--1", "+1", "1e", ".", ",", "-", "−3"),
            *("40°", "40 %", "4 m", "4m", "100 kN", "270 kg/m³", "400-500", "10..20"),
            *("=1+1", "#REF!", "TRUE", "wahr", "ja", "x", " ", "\u00a0", "\t", "\n"),
            *("free", "sliding", "no-slip", "glissant", "R1", "A1", "tested", "essai"),
            *("\x00", "\x1b[2J", "\u202e", "\ud800", "\ufeff", "\u2028", "9" * 400),
        ]
    ),
)
TYPED = st.one_of(WRITTEN, SIGNS)
KNOWN_WORDS = st.sampled_from(
    sorted(
        {
            name
            for plan in (*SHEETS, *map(load_plan, TABLES))
            for field in plan.fields
            for name in field.names
        }
    )
)
UNITS = st.sampled_from(
    [
        *("", "[m]", "[kN]", "[kN/m]", "[deg]", "[°]", "[%]", "(cm)", "in mm", "[-]"),
        *("[kg/m3]", "[g/cm3]", "[]", "[", "[m][kN]", "[N/mm²]", "[furlong]", "[MN]"),
    ]
)
HEADINGS = st.one_of(
    st.tuples(KNOWN_WORDS, UNITS).map(" ".join),
    st.tuples(KNOWN_WORDS, UNITS).map("\n".join),
    KNOWN_WORDS.map(str.upper),
    st.tuples(SIGNS, UNITS).map(" ".join),
)
JSON_VALUES = st.recursive(
    st.one_of(st.none(), st.booleans(), NUMBERS, TYPED),
    lambda inner: st.one_of(
        st.lists(inner, max_size=3), st.dictionaries(SIGNS, inner, max_size=3)
    ),
    max_leaves=5,
)


@st.composite
def spoilt_bytes(draw: st.DrawFn, sound: Callable[[], bytes]) -> bytes:
    """Sound content with signs changed, cut off, put in or doubled; or noise."""
    if draw(st.integers(0, 9)) == 0:
        return draw(st.binary(max_size=2000))
    content = bytearray(sound())
    for _ in range(draw(st.integers(1, 6))):
        place = draw(st.integers(0, max(len(content) - 1, 0)))
        match draw(st.integers(0, 4)):
            case 0:
                content[place : place + 1] = draw(st.binary(min_size=1, max_size=1))
            case 1:
                content[place:place] = draw(st.binary(max_size=8))
            case 2:
                del content[place : place + draw(st.integers(1, 400))]
            case 3:
                content[place:place] = content[place : place + 200]
            case 4:
                written = draw(WRITTEN).encode("utf-8", "surrogatepass")
                content[place : place + len(written)] = written
    return bytes(content)


@st.composite
def spoilt_tree(draw: st.DrawFn, sound: Callable[[], Any]) -> Any:
    """Sound tables or documents with values changed, keys taken away or put in."""
    tree = copy.deepcopy(sound())
    for _ in range(draw(st.integers(1, 3))):
        node = tree
        while True:
            keys = list(node) if isinstance(node, dict) else list(range(len(node)))
            if not keys:
                break
            key = draw(st.sampled_from(keys))
            below = node[key]
            if isinstance(below, dict | list) and draw(st.integers(0, 7)):
                node = below
                continue
            change = draw(st.integers(0, 9))
            if change == 0:
                del node[key]
            elif change == 1 and isinstance(node, dict):
                node[draw(SIGNS)] = draw(JSON_VALUES)
            elif change == 2 and isinstance(node, list):
                node.append(copy.deepcopy(below))
            elif isinstance(below, int | float) and change < 8:
                node[key] = draw(NUMBERS)
            else:
                node[key] = draw(JSON_VALUES)
            break
    return tree


# --- the targets ---------------------------------------------------------------------


@cache
def scratch() -> Path:
    """Folder for the inputs; each overwrites the one before it."""
    holder = tempfile.TemporaryDirectory(prefix="netdesign-fuzz-")
    scratch_holders.append(holder)
    return Path(holder.name)


scratch_holders: list[tempfile.TemporaryDirectory[str]] = []  # alive to the end


@cache
def example_tables() -> dict[str, list[list[str]]]:
    """Cells of a small sound site, as a csv file would have them."""
    return {
        "Rows": [
            [
                *("row", "slope ψ [deg]", "snow height [m normal]", "glide factor N"),
                *("upslope length L [m]", "net type", "post spacing b [m]"),
                "net anchor (foot)",
            ],
            ["R1", "40", "3.0", "free", "20", "N1", "3.5", "A1"],
            ["R2", "35", "2.5", "1.7", "15", "N2", "4", "A2"],
        ],
        "Net types": [
            [
                *("net type", "effective height D_K [m]", "net stiffness [kN/m]"),
                *("uphill guy", "post"),
            ],
            ["N1", "3.5", "9000", "G1", "P1"],
            ["N2", "3", "8000", "", ""],
        ],
        "Anchors": [
            ["anchor type", "tendon R_k [kN]", "pull-out [kN]", "how proven"],
            ["A1", "400", "300", "report"],
            ["A2", "250", "", ""],
        ],
        "Parts": [
            ["rope", "breaking force [kN]"],
            ["G1", "250"],
            ["post", "base R_k [kN]"],
            ["P1", "380"],
        ],
        "Project": [["item", "value"], ["name", "Combe"]],
    }


@st.composite
def spoilt_cells(draw: st.DrawFn) -> dict[str, list[list[str]]]:
    tables = copy.deepcopy(example_tables())
    for _ in range(draw(st.integers(1, 4))):
        rows = tables[draw(st.sampled_from(sorted(tables)))]
        row = rows[draw(st.integers(min(1, len(rows) - 1), len(rows) - 1))]
        row[draw(st.integers(0, len(row) - 1))] = draw(TYPED)
    return tables


@st.composite
def spoilt_headings(draw: st.DrawFn) -> dict[str, list[list[str]]]:
    tables = copy.deepcopy(example_tables())
    for _ in range(draw(st.integers(1, 4))):
        rows = tables[draw(st.sampled_from(sorted(tables)))]
        place = draw(st.integers(0, len(rows[0])))
        if place == len(rows[0]) or draw(st.integers(0, 5)) == 0:
            for row in rows:
                row.insert(place, draw(TYPED))
        rows[0][place] = draw(HEADINGS)
    return tables


def write_delimited(rows: list[list[str]]) -> bytes:
    def quote(cell: str) -> str:
        if not set(cell) & set(';"\r\n'):
            return cell
        return '"' + cell.replace('"', '""') + '"'

    lines = [";".join(map(quote, row)) for row in rows]
    return "\n".join(lines).encode("utf-8", "surrogatepass")


def write_workbook(tables: dict[str, list[list[str]]]) -> bytes:
    """The same as a workbook; what looks like a number is one."""
    buffer = io.BytesIO()
    options = {"in_memory": True, "strings_to_numbers": True, "nan_inf_to_errors": True}
    with xlsxwriter.Workbook(buffer, options) as workbook:
        for name, rows in tables.items():
            sheet = workbook.add_worksheet(name)
            for place, row in enumerate(rows):
                sheet.write_row(place, 0, [one.replace("\ud800", "?") for one in row])
    return buffer.getvalue()


def read_folder(tables: dict[str, list[list[str]]]) -> None:
    folder = scratch() / "site"
    folder.mkdir(exist_ok=True)
    for name, rows in tables.items():
        (folder / f"{name}.csv").write_bytes(write_delimited(rows))
    attempt(lambda: read_site(folder))


def read_content(name: str, content: bytes, *, mark: bool = False) -> None:
    path = scratch() / name
    path.write_bytes(content)
    found = attempt(lambda: read_site(path))
    if mark and isinstance(found, SiteDataError):
        copied = attempt(lambda: annotate_workbook(path, found.findings))
        if isinstance(copied, bytes):
            assert zipfile.is_zipfile(io.BytesIO(copied))


@cache
def sound_workbook() -> bytes:
    path = scratch() / "sound.xlsx"
    write_site_workbook(path, example=True)
    return path.read_bytes()


@cache
def sound_parts() -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(sound_workbook())) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


@st.composite
def spoilt_parts(draw: st.DrawFn) -> bytes:
    """A workbook in which the XML of one part is spoilt, not its packing."""
    parts = dict(sound_parts())
    name = draw(st.sampled_from(sorted(parts)))
    parts[name] = draw(spoilt_bytes(lambda: parts[name]))
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w") as archive:
        for part, content in parts.items():
            archive.writestr(part, content)
    return buffer.getvalue()


def write_toml(tables: dict[str, Any]) -> str:
    """TOML of tables, each value inline."""
    return "".join(f"{json.dumps(key)} = {_inline(v)}\n" for key, v in tables.items())


def _inline(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return repr(value)
    if isinstance(value, int):
        digits = f"{value:x}" if value >= 0 else ""
        return f"0x{digits}" if len(digits) > 16 else str(max(value, -(2**64)))
    if isinstance(value, list):
        return "[" + ", ".join(map(_inline, value)) + "]"
    if isinstance(value, dict):
        inside = (f"{json.dumps(key)} = {_inline(v)}" for key, v in value.items())
        return "{" + ", ".join(inside) + "}"
    return json.dumps("" if value is None else value)


def try_scene(content: bytes) -> None:
    path = scratch() / "scene.toml"
    path.write_bytes(content)
    attempt(lambda: read_scene(path))


def try_scene_tables(tables: dict[str, Any]) -> None:
    try_scene(write_toml(tables).encode("utf-8", "surrogatepass"))


PROFILE_FILES = sorted(
    path.relative_to(find_resource("standards"))
    for path in find_resource("standards").glob("*/*.toml")
)


@st.composite
def spoilt_profile(draw: st.DrawFn) -> tuple[Path, bytes | None]:
    name = draw(st.sampled_from(PROFILE_FILES))
    if draw(st.integers(0, 19)) == 0:
        return name, None  # the file is missing
    sound = (find_resource("standards") / name).read_bytes()
    if draw(st.booleans()):
        return name, draw(spoilt_bytes(lambda: sound))
    tables = draw(spoilt_tree(lambda: tomllib.loads(sound.decode())))
    return name, write_toml(tables).encode("utf-8", "surrogatepass")


def try_profile(drawn: tuple[Path, bytes | None]) -> None:
    name, content = drawn
    folder = scratch() / "profiles" / name.parent
    if not folder.exists():
        shutil.copytree(find_resource("standards") / name.parent, folder)
    if content is None:
        (folder / name.name).unlink()
    else:
        (folder / name.name).write_bytes(content)
    try:
        found = attempt(lambda: load_standard(folder))
    finally:
        shutil.copy(find_resource("standards") / name, folder)
    if not isinstance(found, NetDesignError):
        assert all(
            one.value > 0.0 for one in found.values if not one.id.startswith("snow.c")
        )


@cache
def sound_study() -> Any:
    return json.loads(write_document(build_study()))


def try_study(document: Any) -> None:
    text = json.dumps(document)
    found = attempt(lambda: read_document(text))
    if not isinstance(found, NetDesignError):
        again = read_document(write_document(found))
        assert replace(again, digest="") == replace(found, digest="")


def try_study_bytes(content: bytes) -> None:
    path = scratch() / "study.json"
    path.write_bytes(content)
    code, _, err = run_main(scratch(), ["diff", "study.json", "study.json"])
    assert code in (0, _REFUSED), err
    assert is_shown_only(err)


def try_report(document: Any) -> None:
    """A spoilt study that is read is reported, or refused as contradicting itself."""
    path = scratch() / "study.json"
    path.write_text(json.dumps(document))
    out = scratch() / "out"
    shutil.rmtree(out, ignore_errors=True)
    code, _, err = run_main(
        scratch(), ["report", "study.json", "--out", "out", "--csv", "--force"]
    )
    assert code in (0, 1, _REFUSED, 4, 5), err
    assert "internal error, please" not in err, err
    assert is_shown_only(err)
    if code in (_REFUSED, 5):
        assert not out.exists()
        return
    verdicts = [row["verdict"] for row in document["rows"]]
    assert code or (verdicts and set(verdicts) == {"pass"})


FLAGS = sorted(
    {
        flag
        for command in cli.cli.commands.values()
        for param in getattr(command, "commands", {"": command}).values()
        for option in param.params
        for flag in (*option.opts, *option.secondary_opts)
        if flag.startswith("-")
    }
)
COMMANDS = sorted(cli.cli.commands)
WORDS = st.one_of(
    st.sampled_from(FLAGS),
    TYPED,
    st.sampled_from(
        [
            *("-", "--", "-x", "--jobs=0", "--jobs=-1", "--accuracy=nan", "site.csv"),
            *("scene.toml", "study.json", ".", "/", "missing.xlsx", "250:450", "1:2:3"),
            *("450:250", "nan:1", "1:1", "1:2:3:4", "en", "fr", "de", "steady"),
            *("\udcff", "mesh", "none", "dask://", "dask://x", "a/b.xlsx", "--="),
        ]
    ),
)


def make_folder(name: str, **files: str) -> Path:
    """Folder of these files alone, by the name of each without its ending."""
    folder = scratch() / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    for file, text in files.items():
        (folder / file.replace("_", ".")).write_text(text)
    return folder


SITE = "id;slope\n1;2\n"


def try_options(words: list[str]) -> None:
    """Every command with every option, on inputs that are refused or missing."""
    scene = "[slope]\nangle_deg = 900\n"
    folder = make_folder("options", site_csv=SITE, scene_toml=scene, study_json="{}")
    words = [word for word in words if not {"\0", "\ud800"} & set(word)]  # no shell can
    try:
        code, _, err = run_main(folder, words)
    finally:
        made = {path.name for path in folder.iterdir()}
    assert_refused(code, err, 0, 2)
    assert not [name for name in made if name.endswith((".html", ".json.tmp"))]


def assert_refused(code: int, err: str, *others: int) -> None:
    assert code in (_REFUSED, *others), (code, err)
    assert "internal error, please" not in err, err
    assert is_shown_only(err), err


QUICK = ("check", "solve", "envelope", "report", "diff", "standards")
# Those that calculate or write on their own: only their options are read.
SLOW = ("bench", "doctor", "paper", "verify", "init")


@st.composite
def command_line(draw: st.DrawFn) -> list[str]:
    # with the example a check would be calculated, for a long time
    words = [w for w in draw(st.lists(WORDS, max_size=6)) if w != "--example"]
    command = draw(st.sampled_from((*QUICK, *SLOW, "")))
    if command in SLOW:
        return [command, "--no-such-option", *words]
    return [command, *words] if command else words


@st.composite
def config_file(draw: st.DrawFn) -> bytes:
    names = st.one_of(st.sampled_from([flag.lstrip("-") for flag in FLAGS]), SIGNS)
    table = draw(st.dictionaries(names, JSON_VALUES, max_size=4))
    command = draw(st.one_of(st.sampled_from(COMMANDS), SIGNS))
    return write_toml({command: table}).encode("utf-8", "surrogatepass")


def try_config(content: bytes) -> None:
    folder = make_folder("config", site_csv=SITE)
    (folder / "netdesign.toml").write_bytes(content)
    code, _, err = run_main(folder, ["check", "site.csv"])
    assert_refused(code, err, 2)


END = FailedSolution(
    outcome=Outcome.DIVERGED, reason=say("text.as_given", text="residual grew")
)


@cache
def sound_store() -> bytes:
    path = scratch() / "sound.sqlite"
    with CaseStore(path, lambda _: None) as store:
        for number in range(3):
            store.keep(str(number), END)
        store._base.execute("PRAGMA journal_mode = DELETE")
    return path.read_bytes()


def try_store(content: bytes) -> None:
    """A spoilt store gives the cases as they were kept, or none, or is set aside."""
    folder = make_folder("store")
    (folder / "cases.sqlite").write_bytes(content)
    with (
        contextlib.suppress(StoreError, sqlite3.Error),
        CaseStore(folder / "cases.sqlite", lambda _: None) as store,
    ):
        for end in store.find(["0", "1", "2"]).values():
            assert (end.outcome, str(end.reason)) == (END.outcome, str(END.reason))


@dataclass(frozen=True)
class Target:
    """What is drawn, what is done with it, and its share of all examples."""

    name: str
    drawn: st.SearchStrategy[Any]
    try_one: Callable[[Any], None]
    share: float


def try_workbook(content: bytes) -> None:
    read_content("site.xlsx", content)


def try_cells_of_a_workbook(tables: dict[str, list[list[str]]]) -> None:
    read_content("site.xlsx", write_workbook(tables), mark=True)


def try_delimited(content: bytes) -> None:
    read_content("site.csv", content)


def sound_delimited() -> bytes:
    return write_delimited(example_tables()["Rows"])


def sound_scene() -> Any:
    return tomllib.loads(FULL_SCENE)


def sound_document() -> bytes:
    return json.dumps(sound_study()).encode()


TARGETS = (
    Target("bytes-xlsx", spoilt_bytes(sound_workbook), try_workbook, 0.06),
    Target("bytes-parts", spoilt_parts(), try_workbook, 0.05),
    Target("bytes-csv", spoilt_bytes(sound_delimited), try_delimited, 0.10),
    Target("cells", spoilt_cells(), read_folder, 0.15),
    Target("cells-xlsx", spoilt_cells(), try_cells_of_a_workbook, 0.03),
    Target("headings", spoilt_headings(), read_folder, 0.15),
    Target("scene-tables", spoilt_tree(sound_scene), try_scene_tables, 0.11),
    Target("scene-bytes", spoilt_bytes(FULL_SCENE.encode), try_scene, 0.10),
    Target("profile", spoilt_profile(), try_profile, 0.06),
    Target("study", spoilt_tree(sound_study), try_study, 0.05),
    Target("study-bytes", spoilt_bytes(sound_document), try_study_bytes, 0.03),
    Target("report", spoilt_tree(sound_study), try_report, 0.005),
    Target("options", command_line(), try_options, 0.06),
    Target("config", config_file(), try_config, 0.035),
    Target("store", spoilt_bytes(sound_store), try_store, 0.01),
)
assert np.isclose(sum(target.share for target in TARGETS), 1.0)
