# No lookups of LS+D, and none that leaves it out.
/^pm_status pm_lookup_caustic(/,/^}/d
/^pm_status pm_lookup_marked(/,/^}/d
/^bool pm_lookup_has_marked(/,/^}/d
s/PM_PHOTON_FIRST | PM_PHOTON_CAUSTIC/PM_PHOTON_FIRST/
