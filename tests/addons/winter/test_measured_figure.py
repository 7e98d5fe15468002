"""Measured and computed force in one figure with the air temperature."""

from datetime import datetime, timedelta
from xml.etree import ElementTree

from netdesign.addons.winter.figure import (
    draw_measured,
)
from netdesign.report.words import Words

SVG = "{http://www.w3.org/2000/svg}"
BEGIN = datetime(2003, 1, 20, 6)


def an_entry(count, hours, jump=None):
    """Readings every so many hours; from the jump on twice the force."""
    times = [BEGIN + timedelta(hours=hours * k) for k in range(count)]
    forces = [20.0 + 0.01 * k for k in range(count)]
    if jump is not None:
        forces = [2.0 * f if k >= jump else f for k, f in enumerate(forces)]
    return {
        "winter": "2002/2003",
        "member": "foot_anchor",
        "readings": [
            {"time": time.isoformat(), "force_kN": force}
            for time, force in zip(times, forces, strict=True)
        ],
        "air_temperatures": [],
        "computed": [
            {
                "date": (BEGIN + timedelta(days=4 * k)).date().isoformat(),
                "force_kN": 21.0,
                "low_kN": 19.0,
                "high_kN": 23.0,
            }
            for k in range(12)
        ],
    }


def test_figure_has_readings_chain_band_and_air():
    words = Words("en")
    air = {f"2003-01-{day}": -float(day) for day in range(20, 31)}
    root = ElementTree.fromstring(draw_measured(an_entry(60, 12), air, words))
    shown = [element.text for element in root.iter(f"{SVG}text")]
    for key in ("measured", "computed", "band", "air"):
        assert words(f"winter_measured.{key}") in shown
    assert len(list(root.iter(f"{SVG}polygon"))) == 1
    assert "23/01" in shown
    bare = draw_measured(an_entry(60, 12), {}, words)
    assert words("winter_measured.air") not in bare
