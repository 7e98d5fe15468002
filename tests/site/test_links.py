"""Sheet Links: a chain by type, each link with one strength."""

import pytest

from netdesign.outcome import SiteDataError
from netdesign.site.reader import read_site
from tests.old_example import load_example
from tests.site_lines import write_lines


def read(path, links, ropes=()):
    lines = load_example()
    lines["Links"] = links
    lines["Ropes"] += ropes
    write_lines(path, lines)
    return read_site(path)


def test_links_of_a_type_make_its_chain_in_their_order(tmp_path):
    chain = [
        {"type": "G18", "link": "thimble", "strength": 213.5},
        {"type": "A32-tested", "link": "eye", "strength": 310},
        {"type": "G18", "link": "shackle", "working_limit": 64.2, "count": 2},
        {"type": "E28", "link": "plate", "strength": 501, "angle": 12},
    ]
    site = read(tmp_path / "site.xlsx", chain)
    thimble, shackle = site.links["G18"]
    assert (thimble.kind, thimble.breaking, thimble.limit) == ("thimble", 213.5e3, None)
    assert (shackle.limit, shackle.count, shackle.angle) == (64.2e3, 2, None)
    assert site.links["E28"][0].angle == pytest.approx(0.20944, rel=1e-4)
    assert set(site.links) == {"G18", "A32-tested", "E28"}
    assert shackle.source.startswith("Links!")


@pytest.mark.parametrize(
    ("link", "said"),
    [
        ({"type": "G19", "link": "eye", "strength": 90}, "no id of sheet Ropes / Anch"),
        ({"type": "G18", "link": "eye"}, "is empty: neither"),
        (
            {"type": "G18", "link": "eye", "strength": 90, "working_limit": 30},
            "is given beside",
        ),
        ({"type": "G18", "link": "hook", "strength": 90}, "hook"),
    ],
)
def test_a_link_without_a_type_or_with_two_strengths_is_refused(tmp_path, link, said):
    with pytest.raises(SiteDataError, match="Links") as refused:
        read(tmp_path / "site.xlsx", [link])
    assert said in str(refused.value)
