"""Page, document and workbook of one drawn study, read as a stranger would: all alike.

Nothing here asks the program what it shows: numbers of the workbook are rounded to the
decimals that the page prints. The site is drawn, solved and judged.
"""

import math
import random
import re

import pytest

from netdesign.checks import load_standard
from netdesign.report.page.html import render_html
from netdesign.report.workbook.excel import render_workbook
from netdesign.site.model import InputEcho
from netdesign.snow.ground import GroundLaw
from netdesign.structure.layout import SupportLayout
from netdesign.study.judge import judge_site
from netdesign.words.catalogue import load_texts
from netdesign.words.message import say
from tests.grid import solve_site
from tests.report.reading import PageReader, read_checks, read_rows, read_workbook
from tests.small_site import RUN, build_row, build_site, resist

pytest.importorskip("docx")
from netdesign.report.document.word import render_document
from tests.report.document.reading import W, open_word, squeeze

SEED = 20261122
PLAIN = re.compile(r"^-?\d+(?:\.\d+)?(?:e-?\d+)?$")


def draw_row(dice, name):
    """A row of untidy values: some checks pass, some fail, some lack a resistance."""
    height = dice.uniform(2.2, 3.4)
    slope = dice.uniform(31.0, 44.0)
    weak = {
        f"{member}__{mode}": dice.choice([None, 10 ** dice.uniform(4.6, 6.2)])
        for member, mode in (
            ("foot_anchor", "tendon"),
            ("foot_anchor", "pull_out"),
            ("uphill_guy", "rope"),
            ("post", "compression"),
            ("post_base", "bearing"),
        )
    }
    spacing = dice.uniform(2.6, 4.1)
    inputs = tuple(
        InputEcho(
            label=say(f"column.Nets.{key}"),
            unit=unit,
            text=f"{value:.7g}",
            value=value,
            cell=f"Nets!{column}{2 + int(name[1:])}",
        )
        for key, value, unit, column in (
            ("slope_angle", slope, "deg", "B"),
            ("net_height", height, "m", "I"),
            ("post_spacing", spacing, "m", "L"),
        )
    )
    return build_row(
        name,
        slope_angle=math.radians(slope),
        snow_thickness=0.97 * height,
        net_height=height,
        upslope_length=dice.uniform(4.3, 11.9),
        net_stiffness_per_m=dice.uniform(4e6, 1.7e7),
        slack=dice.uniform(0.011, 0.083),
        ground=GroundLaw(kind=dice.choice(["free", "no-slip"])),
        layout=SupportLayout(
            post_spacing=spacing,
            uphill_anchor_distance=height,
            downhill_anchor_distance=height,
        ),
        resistances=resist(dice.uniform(3e5, 9e5), **weak),
        inputs=inputs,
    )


@pytest.fixture(scope="module")
def study():
    dice = random.Random(SEED)
    site = build_site(*(draw_row(dice, f"R{number}") for number in (1, 2)))
    judged = judge_site(
        site, solve_site(site, RUN), load_standard("nf-p-95-304-style"), RUN
    )
    verdicts = {check.verdict for row in judged.rows for check in row.checks}
    assert len(verdicts) >= 3, "the drawn site has too few verdicts to compare"
    return judged


@pytest.fixture(scope="module", params=["en", "fr"])
def outputs(request, study):
    """Language, checks of page, document and workbook, their tables of inputs."""
    language = request.param
    page = PageReader(render_html(study, language, "full"))
    written = render_document(study, language, "full")
    text = " ".join(one.text for one in open_word(written).paragraphs)
    document = list_tables(written), text
    book = read_workbook(render_workbook(study, language))
    return language, page, document, book


def list_shown(tables, texts):
    """Checks of forces of a page or document: by place in order, row by row.

    Every line names the check; its cells are type, R_d, then E_d and utilisation inside
    the row, and the same at its end.
    """
    head, kind = clean(texts["heading.check"]), clean(texts["heading.type"])
    of_rows = [one for one in tables if one and one[0][:2] == [head, kind]]
    found = []
    for table in of_rows:
        checks = {}
        for cells in table[1:]:
            if len(cells) != 7:
                continue
            for place, shown in (("", cells[3:5]), ("end", cells[5:7])):
                if shown != ["-", "-"]:
                    used = shown[1].split(" (")[0]
                    checks[cells[0], place] = (cells[2], shown[0], used)
        found.append(checks)
    return found


def clean(text):
    return " ".join(text.split())


def list_tables(content):
    """Tables of a document; a line of a cell ends with a blank, and a lowered index."""
    ends = {f"{W}br", f"{W}p"}

    def read(cell):
        parts = [
            (one.text or "") if one.tag == f"{W}t" else " "
            for one in cell.iter()
            if one.tag == f"{W}t" or one.tag in ends
        ]
        return clean("".join(parts))

    return [
        [[read(cell) for cell in line.tc_lst] for line in table._tbl.tr_lst]
        for table in open_word(content).tables
    ]


def list_stored(book, texts, rows):
    """Checks of the workbook by net row, then name: verdict, utilisation, E_d, R_d."""
    sheet = book[texts["heading.checks"]]
    found = {row.id: {} for row in rows}
    for one in read_checks(sheet):
        lines = [one.steps.get(symbol) for symbol in ("E_d", "R_d")]
        forces = [sheet[f"H{line}"].value if line else "-" for line in lines]
        found[one.row][one.name] = (one.verdict, one.used[1], *forces)
    return list(found.values())


def is_shown(number, text):
    """A number of the workbook, rounded as the other output prints it."""
    if text is None or text == "-":
        return number in (None, "-")
    plain = text.replace(",", ".")
    assert PLAIN.match(plain), text
    decimals = len(plain.partition(".")[2])
    return f"{number:.{decimals}f}" == plain or math.isclose(
        float(plain), number, abs_tol=0.5000001 * 10.0**-decimals
    )


@pytest.mark.long
def test_no_value_of_a_check_differs(study, outputs):
    language, page, (document, between), book = outputs
    texts = load_texts(language)
    on_page = list_shown([t for ts in page.tables.values() for t in ts], texts)
    in_document = list_shown(document, texts)
    assert len(on_page) == len(in_document) == len(study.rows)
    stored, compared = list_stored(book, texts, study.rows), 0
    for shown, written, kept in zip(on_page, in_document, stored, strict=True):
        inside = {(squeeze(title), at): cells for (title, at), cells in written.items()}
        signs = {}
        for (title, at), cells in shown.items():
            resistance, demand, used = cells
            symbol, word, check = part_title(title, texts)
            assert inside[squeeze(f"{symbol}{check}"), at] == cells
            line = kept.pop(find_name(check, kept, is_end=at == "end"))
            signs.setdefault((symbol, word, check), set()).add(line[0])
            numbers = zip(line[1:], (used, demand, resistance), strict=True)
            for number, text in numbers:
                assert is_shown(number, text), (check, number, text)
                compared += 1
        for (_, word, check), words in signs.items():
            assert word in words, check  # the worse of both places
    beside = list_beside("".join(page.text), texts)
    assert beside == list_beside(between, texts)
    assert len(beside) == len(study.rows)
    for told, kept in zip(beside, stored, strict=True):
        for title, resistance, *used in told:
            for is_end in (False, True):
                if used[is_end] != "-":
                    line = kept.pop(find_name(title, kept, is_end=is_end))
                    assert line[0] == texts["verdict.pass"]
                    assert is_shown(line[1], used[is_end])
                    assert is_shown(line[3], resistance)
                    compared += 2
    assert compared > 90
    # what is left in the workbook are the checks that follow from no force
    assert all(line[2] == "-" for kept in stored for line in kept.values())


def list_beside(text, texts):
    """Checks told below the table of a row, row by row: name, R_d, utilisations."""
    lead = texts["show.less_used"].partition("{checks}")[0]
    mark = re.escape(clean(lead.rpartition("/")[2]))
    rows = []
    for told in re.findall(rf"{mark} ((?:[^.]|\.\d)+)\.", clean(text)):
        rows.append([])
        for of_member in told.split(" · "):
            member, _, modes = of_member.partition(": ")
            for mode in re.split(r"\s?; ", modes):
                first, _, used = mode.rpartition(", ")
                name, _, resistance = first.rpartition(" ")
                title = f"{member.strip()}, {name}"
                rows[-1].append((title, resistance, *used.split(" / ")))
    return rows


def part_title(title, texts):
    """Symbol and word of a verdict, and the name of the check."""
    symbol, _, rest = title.partition(" ")
    words = [text for key, text in texts.items() if key.startswith("verdict.")]
    word = max((one for one in words if rest.startswith(one)), key=len)
    return symbol, word, rest.removeprefix(word).strip()


def find_name(title, kept, *, is_end):
    """Name in the workbook of a check on the page: the longest that begins its cell."""
    names = [
        name
        for name in kept
        if title.startswith(name if not is_end else name.rpartition(",")[0])
        and (not is_end or name.count(",") >= 2)
    ]
    return max(names, key=len)


def test_no_input_differs(study, outputs):
    language, page, (document, _), book = outputs
    texts = load_texts(language)
    head = texts["heading.input"]
    wanted = [row.id for row in study.rows]
    count = len(wanted)
    (shown,) = [
        t
        for ts in page.tables.values()
        for t in ts
        if t and t[0] and t[0][0] == head and t[0][-count:] == wanted
    ]
    (written,) = [
        t
        for t in document
        if t and t[0] and t[0][0] == head and t[0][-count:] == wanted
    ]
    assert written == shown
    stored = {
        (line[texts["heading.net_row"]], line[head]): line[
            texts["heading.understood_as"]
        ]
        for line in read_rows(book[texts["heading.inputs"]], texts["heading.net_row"])
    }
    compared = 0
    for line in shown[1:]:
        for row, text in zip(wanted, line[-count:], strict=True):
            assert is_shown(stored[row, line[0]], text.rstrip("*‡")), (row, line)
            compared += 1
    assert compared == 3 * count


def test_a_changed_value_is_seen(outputs):
    """A number that is one more in its last place is not the one that is printed."""
    language, _, (document, _), _ = outputs
    texts = load_texts(language)
    for checks in list_shown(document, texts):
        for resistance, demand, _ in checks.values():
            for text in (resistance, demand):
                if text == "-":
                    continue
                number = float(text.replace(",", "."))
                decimals = len(text.replace(",", ".").partition(".")[2])
                assert is_shown(number, text)
                assert not is_shown(number + 1.1 * 10.0**-decimals, text)
