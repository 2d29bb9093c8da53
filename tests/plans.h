// What tests ask of every plan.
#ifndef PM_TEST_PLANS_H
#define PM_TEST_PLANS_H

#include "plan.h"

/// One part is needed or not, as wanted, and says why in one sentence without a full stop.
/// @param what  names the scene when the test fails
void pm_plans_check(const pm_plan *plan, const char *what, pm_plan_part part, bool want);

#endif
