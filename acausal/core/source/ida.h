/* SUNDIALS IDAS as a stepper, where its library is at hand: none of it is compiled or linked here. */
#ifndef ACAUSAL_IDA_H
#define ACAUSAL_IDA_H

#include "stepper.h"

/* Names of the functions of IDAS, NULL behind the last; their addresses, in this order, have to be given before a stepper is made. */
AC_PUBLIC const char *ac_ida_function(int32_t k);
AC_PUBLIC void ac_ida_load(void *const *address);

AC_PUBLIC ac_stepper *ac_ida_make(const ac_equations *equations); /* NULL without memory, or without these functions */

#endif
