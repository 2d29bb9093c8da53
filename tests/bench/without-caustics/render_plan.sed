# No caustic map is asked for, split or missed.
/bool caustic = lives/d
/bool from_global = /d
s/indirect || (caustic && from_global)/indirect/
/^    case PM_MAP_CAUSTIC:/,/return caustic/d
/if (kind == PM_MAP_CAUSTIC) {/,/^    }/d
/if (plan->item\[PM_PLAN_CAUSTIC\]/,/^    }/d
