"""Batches of simulated people, and what their tables show."""
