"""Files of other programs: a module a format. What could change the answer is refused, with its file and line."""
