"""A study from plan to report: `./navvi study`."""
