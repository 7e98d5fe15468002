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
from netdesign.report.words import VERDICTS
from netdesign.report.workbook.excel import render_workbook
from netdesign.site.model import InputEcho
from netdesign.snow.ground import GroundLaw
from netdesign.structure.layout import SupportLayout
from netdesign.study.judge import judge_site
from netdesign.words.catalogue import load_texts
from netdesign.words.message import say
from tests.grid import solve_site
from tests.report.reading import PageReader, read_checks, read_workbook
from tests.small_site import RUN, build_row, build_site, resist

pytest.importorskip("docx")
from netdesign.report.document.word import render_document
from tests.report.document.reading import W, open_word, squeeze

pytestmark = pytest.mark.long
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
    """Language, checks of page, document and workbook."""
    language = request.param
    page = PageReader(render_html(study, language))
    document = list_tables(render_document(study, language))
    book = read_workbook(render_workbook(study, language))
    return language, page, document, book


def list_shown(tables, texts):
    """Lines of members of a page or document, row by row.

    Every line has member, mode, type, place, E_d, R_d, and utilisation behind a sign.
    """
    head = [clean(texts[f"row_page.{one}"]) for one in ("member", "mode", "type")]
    of_rows = [one for one in tables if one and one[0][:3] == head]
    return [[cells for cells in table[1:] if len(cells) == 7] for table in of_rows]


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
    if isinstance(number, str):
        return False
    plain = text.replace(",", ".")
    assert PLAIN.match(plain), text
    decimals = len(plain.partition(".")[2])
    return f"{number:.{decimals}f}" == plain or math.isclose(
        float(plain), number, abs_tol=0.5000001 * 10.0**-decimals
    )


def test_no_value_of_a_check_differs(study, outputs):
    language, page, document, book = outputs
    texts = load_texts(language)
    on_page = list_shown([t for ts in page.tables.values() for t in ts], texts)
    in_document = list_shown(document, texts)
    assert len(on_page) == len(in_document) == len(study.rows)
    stored, compared = list_stored(book, texts, study.rows), 0
    signs = {texts[f"verdict.{key}"]: one.symbol for key, one in VERDICTS.items()}
    for shown, written, kept in zip(on_page, in_document, stored, strict=True):
        assert len(shown) == len(written) > 4
        for cells, other in zip(shown, written, strict=True):
            assert [squeeze(one) for one in cells[:6]] == [*map(squeeze, other[:6])]
            assert squeeze(other[6]).startswith(read_used(cells[6], texts))
            lines = [
                line
                for name, line in kept.items()
                if cells[1] in name and fits(line, cells, texts)
            ]
            assert lines, cells
            assert {cells[6][0]} <= set(signs.values())
            compared += 3
    assert compared > 50


def read_used(cell, texts):
    """Sign and utilisation of a cell, without the word of the verdict."""
    words = [text for key, text in texts.items() if key.startswith("verdict.")]
    for word in sorted(words, key=len, reverse=True):
        cell = cell.replace(word, "", 1)
    return squeeze(" ".join(cell.split()[:2]))


def fits(line, cells, texts):
    """A check of the workbook has the numbers of a line."""
    _, used, demand, resistance = line
    shown = read_used(cells[6], texts)[1:]
    is_known = PLAIN.match(shown.replace(",", ".") or "x")
    return (
        is_shown(demand, cells[4])
        and is_shown(resistance, cells[5])
        and (not is_known or is_shown(used, shown))
    )


def test_a_changed_value_is_seen(outputs):
    """A number that is one more in its last place is not the one that is printed."""
    language, _, document, _ = outputs
    texts = load_texts(language)
    for lines in list_shown(document, texts):
        for cells in lines:
            for text in cells[4:6]:
                if text == "-":
                    continue
                number = float(text.replace(",", "."))
                decimals = len(text.replace(",", ".").partition(".")[2])
                assert is_shown(number, text)
                assert not is_shown(number + 1.1 * 10.0**-decimals, text)
