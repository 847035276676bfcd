/* Functions of other libraries among the columns. Their arguments stand in a chain of AC_PUT, of which the last holds the number. */
#include "core.h"

#include <math.h>

static ac_external *external(const ac_tables *t, double number) {
    if (!t || !(number >= 0 && number < t->count)) return NULL;
    ac_external *own = (ac_external *)(uintptr_t)t->column[(int32_t)number];
    return own && own->count == AC_EXTERNAL ? own : NULL;
}

/* A value of the function whose chain of arguments ends at a place in w. */
double ac_external_value(const ac_tape *t, const double *w, int32_t last, double value) {
    const int32_t results = t->constants + t->inputs, *first = t->first - results, *second = t->second - results;
    ac_external *own = last < results ? NULL : external(t->tables, w[first[last]]);
    if (!own) return NAN;
    for (int32_t k = own->arguments - 1, at = second[last]; k >= 0; k--, at = second[at]) {
        if (at < results) return NAN; /* in a damaged file */
        own->argument[k] = w[first[at]];
    }
    return own->value(own, (int32_t)value);
}

/* A function that CasADi calls (its manual, 5.2) with one column: the number, which value, and the arguments. */
static long long column[] = {3, 1, 1};

AC_PUBLIC void ac_casadi_call_rows(int32_t rows) { column[0] = rows; }
AC_PUBLIC long long ac_casadi_call_n_in(void) { return 1; }
AC_PUBLIC const long long *ac_casadi_call_sparsity_in(long long k) { return k ? NULL : column; }

AC_PUBLIC int ac_casadi_call(const double **argument, double **result, long long *iw, double *w, int memory) {
    (void)iw, (void)w, (void)memory;
    const double *given = argument[0];
    ac_external *own = given ? external(ac_shared_tables(), given[0]) : NULL;
    if (own) for (int32_t k = 0; k < own->arguments; k++) own->argument[k] = given[2 + k];
    if (result[0]) result[0][0] = own ? own->value(own, (int32_t)given[1]) : NAN;
    return 0;
}
