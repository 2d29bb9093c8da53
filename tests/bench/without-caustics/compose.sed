# The caustic layer is not asked for.
/sources->caustic, at, path/d
