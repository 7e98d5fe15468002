"""Sheet Uncertainty: lines of quantities, for a net row or all; every fault."""

from netdesign.addons.reliability.uncertainty_sheet import find_uncertain
from tests.each import each

HEADINGS = [
    *("net row", "variable", "distribution", "coefficient of variation"),
    *("mean over typed value", "return period", "source"),
]
HEIGHT = [None, "snow height", None, 0.27, None, 80, "station 1964-2019"]
MODEL = ["R1", "model factor", "lognormal", 0.17, 1.08, None, "fit of 2026"]


def with_lines(book, *lines):
    book["Uncertainty"] = [HEADINGS, *map(list, lines)]
    return book


def test_a_line_holds_for_its_row_before_that_of_all(book):
    of_all = [None, "model factor", None, 0.23, None, None, "judgement"]
    site = with_lines(book, HEIGHT, of_all, MODEL).read()
    first, second = (one.id for one in site.rows)
    height = find_uncertain(site, second, "snow_height")
    assert (height.variation, height.period) == (0.27, 80.0)
    assert (height.distribution, height.mean_ratio) == ("", None)
    assert height.source == "station 1964-2019"
    own, general = (find_uncertain(site, one, "model") for one in (first, second))
    assert (own.variation, own.mean_ratio) == (0.17, 1.08)
    assert own.distribution == "lognormal"
    assert general.variation == 0.23
    assert find_uncertain(site, first, "density") is None


@each(
    "lines, cell",
    [
        ([["R9", *MODEL[1:]]], "A2"),
        ([MODEL, MODEL], "B3"),
        ([[*MODEL[:3], 17, *MODEL[4:]]], "D2"),
        ([[*MODEL[:6], None]], "G2"),
        ([[None, "weather", *MODEL[2:]]], "B2"),
    ],
)
def test_faults_are_refused_at_their_cells(book, lines, cell):
    findings = with_lines(book, *lines).refuse()
    (finding,) = [one for one in findings if one.severity == "error"]
    assert (finding.sheet, finding.cell) == ("Uncertainty", cell)
