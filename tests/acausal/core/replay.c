/* Integrate a stored model: replay FILE SPAN OUTPUTS TOLERANCE. Names of the states; time, states, algebraic unknowns and integrals at
   each output; how it ended, counts and the time that was reached. */
#include "core.h"

#include <stdio.h>
#include <stdlib.h>

#define MOST 1000000 /* steps */

static void *read_file(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END)) return NULL;
    const long end = ftell(file);
    char *bytes = end < 0 ? NULL : malloc((size_t)end + 1);
    rewind(file);
    *length = bytes ? fread(bytes, 1, (size_t)end, file) : 0;
    fclose(file);
    return bytes;
}

static void print_all(const double *number, size_t count) {
    for (size_t k = 0; k < count; k++) printf(" %.17g", number[k]);
}

static int replay(const ac_model *m, double span, int32_t outputs, double tolerance) {
    const ac_equations *e = &m->equations;
    const size_t nx = (size_t)e->nx, nz = (size_t)e->nz, n = (size_t)outputs;
    double *memory = calloc(n * (nx + nz + 3) + 1, sizeof *memory);
    ac_rodas *r = ac_rodas_make(e);
    int32_t end = AC_MEMORY;
    if (memory && r) {
        double *time = memory, *x = time + n + 1, *z = x + n * nx, *integral = z + n * nz;
        for (size_t k = 0; k <= n; k++) time[k] = m->time + span * (double)k / (double)outputs;
        const ac_request request = {
            .tolerance = tolerance, .size = m->size, .rate = m->rate, .smooth = 1, .most = MOST, .outputs = outputs,
            .time = time, .x = x, .z = z, .integral = integral,
        };
        ac_progress done;
        ac_rodas_begin(r, &request, m->x, m->z, m->p, m->c);
        end = ac_rodas_go(r, MOST, &done);
        const char *name = m->names;
        for (size_t k = 0; k < nx; k++) {
            printf("%s\t", name);
            while (*name++) {}
        }
        printf("\n");
        for (size_t k = 0; k < (size_t)done.written; k++) {
            print_all(time + k + 1, 1);
            print_all(x + k * nx, nx);
            print_all(z + k * nz, nz);
            print_all(integral + 2 * k, 2);
            printf("\n");
        }
        printf("%d %lld %lld %lld %lld %lld %.17g\n", (int)end, (long long)done.steps, (long long)done.refused,
               (long long)done.slopes, (long long)done.values, (long long)done.pivots, done.time);
    }
    ac_rodas_free(r);
    free(memory);
    return end == AC_MEMORY;
}

int main(int count, char **given) {
    if (count != 5) return 2;
    size_t length;
    int32_t why;
    void *bytes = read_file(given[1], &length);
    if (!bytes) return 2;
    ac_model *m = ac_model_read(bytes, length, &why);
    free(bytes);
    if (!m) {
        printf("refused %d\n", (int)why);
        return 1;
    }
    const int failed = replay(m, atof(given[2]), atoi(given[3]), atof(given[4]));
    ac_model_free(m);
    return failed;
}
