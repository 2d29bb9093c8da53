# Deposits are not marked, and no pass stops at the first D event.
/bool caustic = flight->bounce > 0/d
s/(caustic || tracing->map != PM_MAP_CAUSTIC)/true/
s/, bool caustic)/)/
s/is_wanted(tracing, at, caustic)/is_wanted(tracing, at)/
/\.caustic = caustic,/d
/^static bool is_done(/,/^}/d
/if (is_done(/,/^    }/d
