/\.caustic_only = /d
