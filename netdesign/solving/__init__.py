"""Solves of cases: by any method, in processes or on a cluster, kept in a store."""
