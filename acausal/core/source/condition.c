/* Conditions at an instant. As `Instants` of Python takes them. */
#include "condition.h"

#include <math.h>

/* Whether a condition holds from now on: where it is negative; what passes 0 just now counts as passed. `change`: its rate, over
   a whole run; `least`: such a change of what moves; `width`: how far it may be off; `soon`: whether it passes now. */
int ac_holds(double value, double change, double width, double least, int soon, int before) {
    if (fabs(change) > least && soon && fabs(value) <= width) return change < 0;
    return value == 0 ? before : value < 0;
}
