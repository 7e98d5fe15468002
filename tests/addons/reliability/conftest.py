"""A small sound site, to which sheets of the add-on are added."""

from tests.site.conftest import book as book
