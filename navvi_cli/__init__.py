"""The command ./navvi: a file of `commands` for each sub-command (CONTRIBUTING.md tells how to add one).

Modules import at their top only what is needed to parse arguments, so that help and errors come at once.
"""
