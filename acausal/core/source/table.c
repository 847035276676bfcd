/* Columns of numbers that equations look up: an interpolant is a polynomial whose origin and coefficients stand in them. */
#include "core.h"

#include <math.h>

/* The numbers of a column and how many there are; NULL where no column has this number. */
static const double *column(const ac_tables *t, double number, double *count) {
    if (!t || !(number >= 0 && number < t->count)) return NULL;
    const double *at = t->column[(int32_t)(number + 0.5 < t->count ? number + 0.5 : number)];
    if (!at) return NULL;
    *count = at[0];
    return at + 1;
}

/* How many numbers of an ascending column are not above x. `last`: where x was before, whatever it is. */
double ac_find(const ac_tables *t, double x, double number, double last) {
    double count;
    const double *at = column(t, number, &count);
    if (!at || isnan(x)) return NAN;
    int32_t low = 0, high = (int32_t)count;
    if (last >= 0 && last <= count) {
        const int32_t k = (int32_t)last;
        if (k > 0 && !(at[k - 1] <= x)) high = k - 1;
        else if (k == high || x < at[k]) return k;
        else if (k + 1 == high || x < at[k + 1]) return k + 1;
        else low = k + 2;
    }
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (at[middle] <= x) low = middle + 1;
        else high = middle;
    }
    return low;
}

/* A number of a column by its place, counted from 0. */
double ac_load(const ac_tables *t, double place, double number) {
    double count;
    const double *at = column(t, number, &count);
    return at && place >= 0 && place < count ? at[(int32_t)place] : NAN;
}

/* The columns of this process: CasADi looks up these, and so do runs. */
static const ac_tables *shared;

void ac_share_tables(const ac_tables *tables) { shared = tables; }

const ac_tables *ac_shared_tables(void) { return shared; }

/* Functions that CasADi calls (its manual, 5.2): arguments and results by address. */
AC_PUBLIC int ac_casadi_find(const double **argument, double **result, long long *iw, double *w, int memory) {
    (void)iw, (void)w, (void)memory;
    if (result[0]) result[0][0] = ac_find(shared, argument[0] ? *argument[0] : 0, argument[1] ? *argument[1] : 0, -1);
    return 0;
}

AC_PUBLIC int ac_casadi_load(const double **argument, double **result, long long *iw, double *w, int memory) {
    (void)iw, (void)w, (void)memory;
    if (result[0]) result[0][0] = ac_load(shared, argument[0] ? *argument[0] : 0, argument[1] ? *argument[1] : 0);
    return 0;
}

AC_PUBLIC long long ac_casadi_find_n_in(void) { return 2; }
AC_PUBLIC long long ac_casadi_load_n_in(void) { return 2; }
