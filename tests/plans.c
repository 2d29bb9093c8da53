// The check names the scene and quotes the reason.
#include "plans.h"

#include "test.h"

#include <string.h>

void pm_plans_check(const pm_plan *plan, const char *what, pm_plan_part part, bool want)
{
    const pm_plan_item *item = &plan->item[part];
    CHECK_THAT(item->needed == want, "%s: %s is %sneeded (%s)", what, pm_plan_name(part),
               item->needed ? "" : "not ", item->why);
    size_t length = strlen(item->why);
    CHECK_THAT(length > 0 && item->why[length - 1] != '.', "%s: %s: why is \"%s\"", what,
               pm_plan_name(part), item->why);
}
