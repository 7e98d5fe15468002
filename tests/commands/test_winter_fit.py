"""The command ``winter --fit``: measured forces narrow the force to design for."""

import json
from datetime import date, timedelta

import openpyxl
import pytest

from netdesign.commands.winter import _is_proven
from netdesign.report.page.winter_page import render_winter
from netdesign.report.words import Words
from netdesign.words.catalogue import LANGUAGES
from tests.short_example import write_short_example

FIRST = date(2003, 1, 11)
# Snow of one week that settles and melts.
HEIGHTS = [0, 70, 150, 165, *(160 - 2.6 * k for k in range(30)), 40, 0]
QUICK = ("--accuracy", "0.05", "--jobs", "1", "--every", "60", "--quiet", "--json")
KNOWN = ("--known", "height", "--known", "friction", "--known", "slack")
MEASURED = [(8, 9.1), (14, 8.3), (19, 11.7), (25, 11.2), (31, 10.4)]


def write_site(path, forces):
    """Row R2 of the example with forces of its foot anchors on some days."""
    write_short_example(path, ["R2"])
    book = openpyxl.load_workbook(path)
    del book["Monitoring"]
    sheet = book.create_sheet("Monitoring")
    sheet.append(["net row", "member", "date and time", "tension [kN]"])
    for day, force in forces:
        moment = f"{FIRST + timedelta(days=day)} 06:00"
        sheet.append(["R2", "foot anchor", moment, force])
    book.save(path)
    return path


@pytest.fixture(scope="module")
def heights(tmp_path_factory):
    path = tmp_path_factory.mktemp("fit") / "station.csv"
    lines = [f"{FIRST + timedelta(days=k)},{h:.1f}" for k, h in enumerate(HEIGHTS)]
    path.write_text("\n".join(["date,HS [cm]", *lines]) + "\n")
    return path


def run(call, tmp_path, heights, forces, *more):
    site = write_site(tmp_path / "site.xlsx", forces)
    ended = call("winter", site, "--heights", heights, "--fit", *KNOWN, *QUICK, *more)
    assert ended.out, ended.err
    document = json.loads(ended.out)
    return ended, document, document["rows"][0]["fit"]


def test_fit_narrows_the_force_and_every_language_shows_it(call, tmp_path, heights):
    ended, document, fit = run(call, tmp_path, heights, MEASURED)
    assert (ended.code, fit["outcome"]) == (0, "fitted")
    assert (fit["days"], fit["readings"], fit["winter"]) == (5, 5, "2002/2003")
    assert fit["known"] == ["friction_angle", "height_factor", "slack"]
    (density,) = fit["parameters"]
    assert density["posterior_deviation"] < density["prior_deviation"] == 0.1
    assert [one["measured_kN"] for one in fit["residuals"]] == [f for _, f in MEASURED]
    of_case = {(one["case"], one["member"]): one for one in fit["forces"]}
    force = of_case["governing", "foot_anchor"]
    assert force["after_deviation"] < force["before_deviation"]
    assert force["before_kN"]["low"] < force["after_kN"]["value"]
    design = of_case["design", "foot_anchor"]  # no parameter left that moves it
    assert design["after_kN"] == pytest.approx(design["before_kN"])
    for language in LANGUAGES:
        page = render_winter(document, language)["winter.html"].decode()
        shown = Words(language).show_fixed(force["after_kN"]["value"], 1)
        assert f">{shown} (" in page
        assert Words(language)("fit_page.forces_caption") in page
        assert Words(language)("fit_page.figure") in page
    refuse(document, fit)


def refuse(document, fit):
    """A fit that is refused proves nothing, and its page says so."""
    assert _is_proven(document)
    forces = [
        one | {"after_kN": None, "after_deviation": None} for one in fit["forces"]
    ]
    fit |= {"outcome": "misfit", "forces": forces}
    assert not _is_proven(document)
    page = render_winter(document, "en")["winter.html"].decode()
    assert "No band after the fit" in page
    assert "narrowed" not in page


def test_forces_without_a_date_cannot_be_fitted(call, tmp_path, heights):
    site = tmp_path / "site.xlsx"
    write_short_example(site, ["R2"])
    ended = call("winter", site, "--heights", heights, "--fit", *QUICK)
    assert ended.code == 3
    assert "no measured forces with a date" in ended.err
