/* Integrate a stored model: replay FILE SPAN OUTPUTS TOLERANCE, by IDAS with one argument more, the library that holds it. Names of the
   states; time, states, algebraic unknowns and integrals at each output; how it ended, counts and the time that was reached. */
#include "ida.h"
#include "rodas.h"

#ifndef _WIN32
#include <dlfcn.h>
#endif

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

static ac_stepper *make(const ac_equations *e, const char *library) {
    if (!library) return (ac_stepper *)ac_rodas_make(e);
#ifndef _WIN32
    void *found[64], *handle = dlopen(library, RTLD_NOW);
    for (int32_t k = 0; handle && ac_ida_function(k); k++) found[k] = dlsym(handle, ac_ida_function(k));
    if (handle) ac_ida_load(found);
#endif
    return ac_ida_make(e);
}

static int replay(const ac_model *m, double span, int32_t outputs, double tolerance, const char *library) {
    const ac_equations *e = &m->equations;
    const size_t nx = (size_t)e->nx, nz = (size_t)e->nz, n = (size_t)outputs;
    double *memory = calloc((n + 1) * (nx + nz + 3) + 1, sizeof *memory);
    ac_stepper *s = make(e, library);
    int32_t end = AC_MEMORY;
    if (memory && s) {
        double *time = memory, *x = time + n + 1, *z = x + n * nx, *integral = z + n * nz, *size = integral + 2 * n;
        for (size_t k = 0; k < nx + nz; k++) size[k] = k < nx ? m->size[k] : 1;
        for (size_t k = 0; k <= n; k++) time[k] = m->time + span * (double)k / (double)outputs;
        const ac_request request = {
            .tolerance = tolerance, .size = size, .rate = m->rate, .smooth = 1, .most = MOST, .share = 1, .outputs = outputs,
            .time = time, .x = x, .z = z, .integral = integral, .order = 5, .newton = 0.05,
        };
        ac_progress done;
        ac_stepper_begin(s, &request, m->x, m->z, m->p, m->c);
        end = ac_stepper_go(s, MOST, &done);
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
    ac_stepper_free(s);
    free(memory);
    return end == AC_MEMORY;
}

int main(int count, char **given) {
    if (count != 5 && count != 6) return 2;
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
    const int failed = replay(m, atof(given[2]), atoi(given[3]), atof(given[4]), given[5]);
    ac_model_free(m);
    return failed;
}
