"""``netdesign map`` from the command line, in three languages."""

import json

from tests.site.lists.answer import answer_list
from tests.site.lists.offices import CONSULTANT


def test_an_own_list_is_mapped_once_and_read_by_every_command(call, tmp_path):
    path = CONSULTANT.write(tmp_path)
    assert call("table", path).code == 3
    assert call("map", path).code == 0
    refused = call("table", path)
    assert refused.code == 3
    assert "Net anchor" in refused.err
    answer_list(CONSULTANT, path)
    shown = call("table", path, "--json")
    assert shown.code == 0, shown.err
    rows = json.loads(shown.out)["rows"]
    assert [row["id"] for row in rows] == [
        line[0] for line in CONSULTANT.sheets[0].lines
    ]
    again = call("map", path, "--force")
    assert again.code == 0
    assert call("check", path, "--dry-run").code == 0
