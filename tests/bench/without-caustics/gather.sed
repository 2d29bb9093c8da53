# No source of caustics, neither for the eye nor where gather rays go on.
/^static pm_status ask_caustic(/,/^}/d
/^static pm_status ask_caustic_marked(/,/^}/d
/^ *\.caustic = /,/: NULL,/d
/bool has_caustic = /d
/bool own = /d
/gather->marked = /d
/^    pm_spectrum caustic = /d
/if (gather->marked) {/,/^    }/d
s/pm_spectrum_add(direct, pm_spectrum_add(caustic, indirect))/pm_spectrum_add(direct, indirect)/
