/* Pivots as numbers, so that a copy goes on with them. */
#include "lu.h"

#include <math.h>
#include <stdlib.h>

/* Numbers that say which pivots were chosen: 1 where there are any, then row, column and scale of each step. */
size_t ac_lu_order_size(const ac_lu *lu) { return 1 + 3 * (size_t)lu->n; }

void ac_lu_order(const ac_lu *lu, double *order) {
    *order++ = lu->ready;
    for (int32_t k = 0; k < lu->n; k++, order += 3) {
        order[0] = lu->ready ? lu->row_of[k] : 0;
        order[1] = lu->ready ? lu->column_of[k] : 0;
        order[2] = lu->ready ? lu->scale[k] : 0;
    }
}

/* Go on with such pivots; 0 where that is not possible. What is found with them is the same bit by bit. */
int ac_lu_reorder(ac_lu *lu, const double *order) {
    const int32_t n = lu->n;
    lu->ready = lu->known = 0;
    if (!*order++) return 1;
    int32_t *place = calloc(4 * (size_t)n + 1, sizeof *place);
    double *ones = malloc(((size_t)lu->start[n] + 1) * sizeof *ones);
    int good = place && ones;
    for (int32_t k = 0; k < n && good; k++, order += 3) {
        good = order[0] >= 0 && order[0] < n && order[1] >= 0 && order[1] < n && order[2] > 0 && isfinite(order[2]);
        if (!good) break;
        place[k] = (int32_t)order[0], place[n + k] = (int32_t)order[1];
        good = !place[2 * n + place[k]]++ && !place[3 * n + place[n + k]]++;
        lu->scale[k] = order[2];
    }
    for (int32_t k = 0; k < lu->start[n] && good; k++) ones[k] = 1;
    good = good && !ac_lu_take(lu, ones, 0, place, place + n);
    lu->ready = good;
    free(place), free(ones);
    return good;
}
