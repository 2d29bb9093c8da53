# Deposits are not marked, and no pass stops at the first D event.
/bool caustic = flight->bounce > 0/d
s/ || (tracing->caustic_only && !caustic)//
/\.caustic = caustic,/d
/if (tracing->caustic_only && !specular) {/,/^    }/d
