"""The use case on a small site: two rows, three densities, three friction angles."""

import math

import pytest

from netdesign.checks import load_standard
from netdesign.outcome import Verdict
from netdesign.study.judge import judge_site
from tests.grid import solve_site
from tests.small_site import ROWS, RUN, build_site

SITE = build_site(*ROWS)
STANDARD = load_standard("nf-p-95-304-style")


@pytest.fixture(scope="module")
def study():
    return judge_site(SITE, solve_site(SITE, RUN), STANDARD, RUN)


def test_drawing_shows_the_case_of_the_largest_utilisation(study):
    row, drawing = study.rows[0], study.rows[0].drawing
    worst = max(
        (check for check in row.checks if check.utilisation is not None),
        key=lambda check: check.utilisation,
    )
    assert drawing.case == worst.case
    assert drawing.net_m[0] == (0.0, 0.0)
    assert drawing.net_m[-1] == pytest.approx(drawing.head_m, abs=1e-4)
    assert drawing.head_m == pytest.approx(
        (2.5 * math.tan(math.radians(30)), 2.5), rel=1e-12
    )
    assert drawing.slope_deg == pytest.approx(38.0, rel=1e-12)


def test_results_must_belong_to_the_rows():
    with pytest.raises(ValueError, match="shorter"):
        judge_site(SITE, solve_site(SITE, RUN)[:1], STANDARD, RUN)


def test_a_site_without_rows_proves_nothing():
    study = judge_site(build_site(), [], STANDARD, RUN)
    assert study.rows == []
    assert study.verdict == Verdict.NOT_PROVEN


def test_provenance_is_enough_to_repeat_the_study(study):
    provenance = study.provenance
    assert provenance.started == "2026-01-02T03:04:05+00:00"
    assert (provenance.site_file, provenance.site_sha256) == ("site.xlsx", "0" * 64)
    assert provenance.settings["accuracy"] == "0.1"
    assert provenance.settings["creep_law"].startswith("boutillier-2004")
    assert {"python", "numpy", "scipy", "scikit-fem"} <= set(provenance.libraries)
    assert "" not in provenance.libraries.values()
