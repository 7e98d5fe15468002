"""Demands against the limits of a profile: pass, fail or not proven."""

from netdesign.checks.check import Check as Check
from netdesign.checks.comparison import RatedForce as RatedForce
from netdesign.checks.comparison import find_resistance as find_resistance
from netdesign.checks.comparison import rate_member as rate_member
from netdesign.checks.geometry import Approval as Approval
from netdesign.checks.geometry import StatedValue as StatedValue
from netdesign.checks.inputs import Band as Band
from netdesign.checks.inputs import Declaration as Declaration
from netdesign.checks.inputs import GivenResistance as GivenResistance
from netdesign.checks.inputs import Proof as Proof
from netdesign.checks.loader import Standard as Standard
from netdesign.checks.loader import list_standards as list_standards
from netdesign.checks.loader import load_default as load_default
from netdesign.checks.loader import load_standard as load_standard
from netdesign.checks.rating import Open as Open
from netdesign.checks.rating import OpenKind as OpenKind
from netdesign.checks.rating import Rating as Rating
from netdesign.checks.schema import StandardValue as StandardValue
