# Nothing differs: the kind of map is all that tracing is told.
