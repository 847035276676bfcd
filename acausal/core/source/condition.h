/* What becomes of a watched condition at an instant. */
#ifndef ACAUSAL_CONDITION_H
#define ACAUSAL_CONDITION_H

int ac_holds(double value, double change, double width, double least, int soon, int before);

#endif
