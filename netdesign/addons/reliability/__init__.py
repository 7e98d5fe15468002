"""Notional reliability: limit states of random variables, FORM, importance sampling."""
