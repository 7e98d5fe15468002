"""Columns of the input workbook and of sheets of add-ons, by table."""

from netdesign.site.columns.all_tables import FURTHER, SHEETS
from netdesign.site.columns.office import TABLES, load_plan

PLANS = {one: load_plan(one) for one in TABLES} | {one.name: one for one in FURTHER}
FIELDS = {name: (*one.fields, *one.items) for name, one in PLANS.items()}
QUANTITIES = {plan.name: (*plan.fields, *plan.items) for plan in SHEETS}
