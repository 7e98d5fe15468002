"""Add-ons: each works beside the core, which finds it by `addon_table.py`."""
