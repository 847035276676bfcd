/* Memory of the one-step method. */
#include "lu.h"
#include "rodas.h"

#include <stdlib.h>
#include <string.h>

ac_rodas *ac_rodas_make(const ac_equations *equations) {
    ac_rodas *r = calloc(1, sizeof *r);
    if (!r) return NULL;
    const ac_equations *e = &r->of;
    r->of = *equations;
    r->n = e->nx + e->nz;
    const size_t n = (size_t)r->n + 1, entries = (size_t)e->start[r->n] + 1;
    const size_t values = ac_tape_length(e->values), slopes = ac_tape_length(e->slopes);
    const size_t powers = e->powers ? ac_tape_length(e->powers) : 0;
    r->timely = e->slopes->outputs > e->start[r->n];
    r->lu = r->kept[0] = ac_lu_make(r->n, e->start, e->row);
    r->block = calloc(values + slopes + powers + (STAGES + 12) * n + entries, sizeof(double));
    if (!r->lu || !r->block) {
        ac_rodas_free(r);
        return NULL;
    }
    r->values = r->block, r->slopes = r->values + values, r->powers = r->slopes + slopes;
    r->y = r->powers + powers;
    r->next = r->y + n, r->stage = r->next + n, r->b = r->stage + n, r->u = r->b + n;
    r->dense = r->u + STAGES * n, r->here = r->dense + 3 * n, r->there = r->here + n, r->left = r->there + n;
    r->most = r->left + n, r->terms = r->most + n, r->matrix = r->terms + n;
    const ac_tape *tapes[] = {e->values, e->slopes, e->powers};
    double *arrays[] = {r->values, r->slopes, r->powers};
    for (int k = 0; k < 3; k++) {
        if (tapes[k]) memcpy(arrays[k], tapes[k]->constant, (size_t)tapes[k]->constants * sizeof(double));
    }
    return r;
}

/* Forget what was integrated: what is found from here on does not depend on it. */
void ac_rodas_renew(ac_rodas *r) {
    r->lu = r->kept[r->turn = 0];
    ac_lu_renew(r->lu);
}

void ac_rodas_free(ac_rodas *r) {
    if (!r) return;
    for (int k = 0; k < KEPT; k++) ac_lu_free(r->kept[k]);
    free(r->block);
    free(r);
}
