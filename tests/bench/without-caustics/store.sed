# No mark in the photon's flags.
/deposit->caustic ?/d
/\.caustic = (photon->flags/d
