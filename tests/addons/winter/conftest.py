"""A small sound site, to which sheets of the add-on are added."""

from tests.site.conftest import refused as refused
from tests.site.conftest import save as save
from tests.site.conftest import sheets as sheets
