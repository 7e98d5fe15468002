"""Headings, sheets and names of checks as workbooks before issue 61 have them."""

import pytest

from netdesign.site.columns.all_tables import SHEETS
from netdesign.site.columns.fields import normalise, split_heading
from netdesign.site.declared_sheet import list_check_names
from tests.each import each

FORMER = {
    ("Nets", "net_height"): ("net height", "hauteur du filet", "Netzhöhe"),
    ("Nets", "foot_anchor"): ("foot anchor", "ancrage de pied", "Fußanker"),
    ("Nets", "slack"): ("mou",),
    ("Nets", "guy_splay"): ("écartement des haubans",),
    ("Nets", "foot_axis"): (
        "foot anchor axis",
        "axe de l'ancrage de pied",
        "Achse des Fußankers",
    ),
    ("Nets", "edge_distance"): (
        "distance à l'arête voisine",
        "Abstand zur nächsten Kante",
    ),
    ("Ends", "foot_anchor"): ("foot anchor", "ancrage de pied", "Fußanker"),
    ("Anchors", "basis"): ("basis", "Grundlage"),
    ("Anchors", "bond_length"): ("Verbundlänge",),
    ("Anchors", "lever_arm"): ("lever arm", "bras de levier", "Hebelarm"),
    ("Anchors", "least_cover"): (
        "least cover of the bond",
        "recouvrement minimal du scellement",
        "Mindestüberdeckung des Verbunds",
    ),
    ("Anchors", "least_edge"): (
        "distance minimale à une arête",
        "Mindestabstand zu einer Kante",
    ),
    ("Links", "link"): ("pièce", "Teil"),
    ("Links", "working_limit"): ("zulässige Traglast (WLL)",),
}


@each("place, name", [(place, name) for place in FORMER for name in FORMER[place]])
def test_a_former_heading_names_its_column(place, name):
    sheet, key = place
    (plan,) = (one for one in SHEETS if one.name == sheet)
    (field,) = (one for one in plan.fields if one.key == key)
    assert split_heading(name)[0] in field.names


@pytest.mark.parametrize(
    ("name", "subject"),
    [
        ("Foot anchor, pull-out", ("foot_anchor", "pull_out", "")),
        ("Fußanker, Ausziehen", ("foot_anchor", "pull_out", "")),
        ("Stützenfuß, Fundation, Druck", ("post_base", "bearing", "")),
        ("Pied de montant, appui au sol", ("post_base", "bearing", "")),
    ],
)
def test_a_former_name_of_a_check_is_read(name, subject):
    assert list_check_names()[normalise(name)] == subject
