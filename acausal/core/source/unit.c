/* Read a unit from its file. As with models nothing in it is believed. */
#include "instance.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define VERSION 9

enum {
    LAYOUT = AC_SECTIONS, ROLES, STARTS, INPUTS, SQUARE, TAPES = SQUARE + 3 * AC_SQUARES, ROW_TAPES = TAPES + AC_TAPES,
    RULES = ROW_TAPES + AC_ROW_TAPES, JUMPS_TO, CALLS, RESULTS_TO, SCALE_PATTERN, CLOSE_PATTERN, CLOSURES, KINDS, LEVELS, COORDINATES_TO, FOLLOW_AT, BOUNDS, LIMITED,
    DAMPED, NOMINAL, NATURAL, TOKEN, ORIGINS, LAWS_TO, LAW_PATTERNS, TABLES, SECTIONS
};
static const char TAG[SECTIONS][AC_TAG + 1] = {
    "numbers", "values", "slopes", "powers", "kinks", "pattern", "start", "sizes", "rates", "names", "layout", "roles", "starts", "inputs",
    "settle", "settleat", "settleof", "begin", "beginat", "beginof", "needed", "neededat", "neededof", "power", "powerat", "powerof",
    "moving", "movingat", "movingof", "head", "shown", "guards", "scales", "timed", "instants", "jumps", "closing", "coords", "limits", "given",
    "laws", "unbroken",
    "watched",
    "energies",
    "rules", "jumpsto", "calls", "resultto", "scalesat", "closeat", "closures", "kinds", "levels", "coordsto", "followat", "bounds", "limited", "damped", "nominal", "natural",
    "token", "origins", "lawsto", "lawsat", "tables",
};

const char *ac_unit_why(int32_t why) {
    static const char *const text[] = {
        "it is read", "it is no model of acausal", "it is of another version of acausal", "it is cut off", "it is damaged",
        "its content contradicts itself", "there is not enough memory",
    };
    return why >= 0 && why <= AC_NO_MEMORY ? text[why] : "it cannot be read";
}

const char *ac_unit_token(const ac_unit *unit) { return unit->token; }

/* Integers that fill a section. */
static const int32_t *integers(ac_section s, int64_t count) {
    const int32_t *found = ac_take(&s, count, sizeof *found);
    return s.left ? NULL : found;
}

static int positive(const double *number, int32_t count) {
    for (int32_t k = 0; k < count; k++) {
        if (!(number[k] > 0)) return 0;
    }
    return ac_all_finite(number, count);
}

static int read_layout(const ac_section *found, ac_unit *u) {
    const ac_equations *e = &u->parts.model.equations;
    const int32_t *n = integers(found[LAYOUT], AC_NUMBERED);
    if (!n || !ac_within(n, AC_NUMBERED, INT32_MAX / 8) || n[10] > AC_LEVELS) return 0;
    u->switches = n[0], u->discretes = n[1], u->closures = n[2], u->shown = n[3], u->watched = n[4], u->timed = n[5];
    u->instants = n[6], u->jumps = n[7], u->constraints = n[8], u->inputs = n[9], u->levels = n[10];
    if ((int64_t)u->switches + u->discretes + u->closures > e->nc) return 0;
    u->role = integers(found[ROLES], e->np);
    u->start_of = integers(found[STARTS], e->nx);
    u->input = integers(found[INPUTS], u->inputs ? 2 * (int64_t)u->inputs + 1 : 0);
    if (!u->role || !u->start_of || !u->input || !ac_within(u->role, e->np, AC_INNER + 1)) return 0;
    for (int32_t k = 0; k < e->nx; k++) {
        if (u->start_of[k] < -1 || u->start_of[k] >= e->np) return 0;
    }
    return ac_within(u->input, u->inputs ? 2 * u->inputs + 1 : 0, e->np);
}

static int read_tapes(const ac_section *found, ac_unit *u) {
    const ac_equations *e = &u->parts.model.equations;
    const int32_t varying = e->nx + e->nz + 1, inputs = varying + e->np + e->nc;
    const int32_t outputs[AC_TAPES] = {
        -1, u->shown, u->watched, -1, u->timed, u->instants, u->jumps, -1, -1, -1, -1, -1, -1,
    };
    for (int k = 0; k < AC_TAPES; k++) {
        const int64_t more = k == AC_CONTINUOUS ? (int64_t)varying + e->nc : k == AC_LAWS ? varying - 1 : 0;
        if (more > INT32_MAX - inputs || !ac_read_tape(found[TAPES + k], inputs + (int32_t)more, 0, varying, &u->tape[k])) return 0;
        /* Without the tape of the clock, the caller decides what that changes. */
        if (outputs[k] >= 0 && u->tape[k].outputs != outputs[k] && (k != AC_TIMED || u->tape[k].outputs)) return 0;
    }
    /* A model without equations of its start is begun from outside. */
    const int32_t head = u->tape[AC_HEAD].outputs, n = e->nx + e->nz;
    ac_section at = found[SCALE_PATTERN];
    if (!ac_read_columns(&at, u->watched, n, &u->scale_start, &u->scale_row) || at.left) return 0;
    if (u->tape[AC_SCALES].outputs != u->scale_start[n]) return 0;
    return head == u->switches + u->discretes || (!head && !found[SQUARE + 3 * AC_INITIAL + 2].left);
}

/* Whether unknowns stand one after the other in the inputs. */
static int ascend(const ac_square *q, int32_t first) {
    for (int32_t k = 0; k < q->n; k++) {
        if (q->unknown[k] != first + k) return 0;
    }
    return 1;
}

/* One square system: its tape, the sparsity of its Jacobian, and the places of its unknowns. */
static int read_square(const ac_section *found, int32_t inputs, int32_t rare, ac_tape *tape, ac_square *q) {
    ac_section at = found[1], of = found[2];
    q->n = (int32_t)(of.left / sizeof *q->unknown), q->tape = tape;
    q->unknown = integers(of, q->n);
    return q->unknown && ac_read_tape(found[0], inputs, rare, inputs, tape) && ac_read_columns(&at, q->n, q->n, &q->start, &q->row)
        && !at.left && tape->outputs == q->n + q->start[q->n] && ac_within(q->unknown, q->n, inputs);
}

static int read_squares(const ac_section *found, ac_unit *u) {
    const ac_equations *e = &u->parts.model.equations;
    const int32_t rare = e->np + e->nc, n = e->nx + e->nz, inputs = rare + n + 1;
    const int32_t moving = (int32_t)(found[SQUARE + 3 * AC_MOVING + 2].left / sizeof(int32_t));
    for (int k = 0; k < AC_SQUARES; k++) {
        const int32_t more = k == AC_MOVING ? moving : 0;
        if (more > INT32_MAX - inputs || !read_square(found + SQUARE + 3 * k, inputs + more, rare, &u->squared[k], &u->square[k])) return 0;
    }
    const ac_square *q = u->square;
    for (int k = AC_INDICATING; k <= AC_POWERING; k++) {
        for (int32_t j = 0; j < q[k].n; j++) {
            if (q[k].unknown[j] < rare + e->nx || q[k].unknown[j] >= rare + n) return 0;
        }
    }
    const ac_tape *t = u->row_tape;
    return q[AC_ALGEBRAIC].n == e->nz && ascend(&q[AC_ALGEBRAIC], rare + e->nx) && (!q[AC_INITIAL].n || q[AC_INITIAL].n == n)
        && ascend(&q[AC_INITIAL], rare) && ascend(&q[AC_MOVING], inputs)
        && ac_read_tape(found[ROW_TAPES + AC_INDICATORS], inputs + moving, rare, inputs + moving, &u->row_tape[AC_INDICATORS])
        && ac_read_tape(found[ROW_TAPES + AC_ENERGIES], inputs, rare, inputs, &u->row_tape[AC_ENERGIES])
        && t[AC_INDICATORS].outputs == 2 * u->watched && (!t[AC_ENERGIES].outputs || t[AC_ENERGIES].outputs == 3);
}

static int read_rules(const ac_section *found, ac_unit *u) {
    const int32_t guards = u->watched + u->timed, *n = integers(found[RULES], 6 * (int64_t)guards);
    u->guard = (const ac_guard *)n;
    u->jump = integers(found[JUMPS_TO], 2 * (int64_t)u->jumps);
    if (!n || !u->jump) return 0;
    for (int32_t k = 0; k < guards; k++) {
        const ac_guard *g = &u->guard[k];
        if (g->on < -1 || g->on >= u->switches || g->jump < 0 || g->jumps < 0 || g->jump > u->jumps - g->jumps) return 0;
    }
    for (int32_t k = 0; k < u->jumps; k++) {
        const int32_t *to = u->jump + 2 * k;
        if (!ac_within(to, 1, 2) || !ac_within(to + 1, 1, to[0] ? u->parts.model.equations.nx : u->discretes)) return 0;
    }
    return 1;
}

/* Calls of functions, whose results are discrete variables. */
static int read_calls(const ac_section *found, ac_unit *u) {
    const int32_t results = (int32_t)(found[RESULTS_TO].left / (2 * sizeof *u->result));
    u->calls = (int32_t)(found[CALLS].left / sizeof *u->call);
    const int32_t *n = integers(found[CALLS], 3 * (int64_t)u->calls);
    u->call = (const ac_call *)n, u->result = integers(found[RESULTS_TO], 2 * (int64_t)results);
    if (!n || !u->result || !ac_within(u->result, 2 * results, u->discretes)) return 0;
    for (int32_t k = 0; k < u->calls; k++) {
        const ac_call *c = &u->call[k];
        if (!ac_within(&c->guard, 1, u->watched + u->timed) || c->result < 0 || c->results < 0 || c->result > results - c->results) return 0;
    }
    return 1;
}

/* Set-valued laws: their discrete variables, and the sparsity of what the tape of them ends with. */
static int read_laws(const ac_section *found, ac_unit *u) {
    const int32_t nz = u->parts.model.equations.nz, n = u->laws = (int32_t)(found[LAWS_TO].left / (5 * sizeof *u->law));
    ac_section at = found[LAW_PATTERNS];
    u->equation = ac_take(&at, n ? nz : 0, sizeof *u->equation);
    u->law = integers(found[LAWS_TO], 5 * (int64_t)n);
    return u->law && u->equation && ac_within(u->equation, n ? nz : 0, nz) && ac_within(u->law, 5 * n, u->discretes) && ac_read_columns(&at, nz, n, &u->gradient_start, &u->gradient_row)
        && ac_read_columns(&at, nz, n, &u->law_start, &u->law_row) && !at.left
        && u->tape[AC_LAWS].outputs == (4 + (int64_t)n) * n + u->gradient_start[n] + u->law_start[n];
}

static int read_closing(const ac_section *found, ac_unit *u) {
    const int32_t nx = u->parts.model.equations.nx;
    ac_section at = found[CLOSE_PATTERN], level = found[LEVELS];
    if (!ac_read_columns(&at, u->constraints, nx, &u->close_start, &u->close_row) || at.left) return 0;
    u->closure = integers(found[CLOSURES], u->constraints);
    u->coordinate = integers(found[COORDINATES_TO], u->tape[AC_COORDINATES].outputs);
    u->kind = integers(found[KINDS], u->constraints);
    ac_section follow = found[FOLLOW_AT];
    u->multiplier = ac_take(&follow, u->constraints, sizeof *u->multiplier);
    u->standing = (int32_t)(follow.left / (2 * sizeof *u->stands));
    u->stands = ac_take(&follow, 2 * (int64_t)u->standing, sizeof *u->stands);
    if (!u->multiplier || !u->stands || follow.left || !ac_within(u->multiplier, u->constraints, u->parts.model.equations.nz)) return 0;
    for (int32_t k = 0; k < u->standing; k++) {
        if (!ac_within(u->stands + 2 * k, 1, u->parts.model.equations.nz) || !ac_within(u->stands + 2 * k + 1, 1, nx)) return 0;
    }
    if (!u->closure || !u->kind || !u->coordinate || u->tape[AC_CLOSING].outputs != u->constraints + u->close_start[nx]) return 0;
    for (int32_t k = 0; k < u->constraints; k++) {
        if (u->closure[k] < -1 || u->closure[k] >= u->closures) return 0;
    }
    for (int32_t k = 0; k < u->levels; k++) {
        ac_level *l = &u->level[k];
        const int32_t *n = ac_take(&level, 2, sizeof *n);
        if (!n) return 0;
        l->rows = n[0], l->columns = n[1];
        l->row = ac_take(&level, l->rows, sizeof *l->row);
        l->column = ac_take(&level, l->columns, sizeof *l->column);
        if (!l->row || !l->column || !ac_within(l->row, l->rows, u->constraints) || !ac_within(l->column, l->columns, nx)) return 0;
    }
    return !level.left && ac_within(u->coordinate, u->tape[AC_COORDINATES].outputs, nx);
}

/* Texts that fill a section, each with a 0 at its end; NULL where they are not as many. */
static const char *texts(ac_section s, int32_t count) {
    size_t ends = 0;
    for (size_t k = 0; k < s.left; k++) ends += !s.at[k];
    return ends == (size_t)count && (count ? !s.at[s.left - 1] : !s.left) ? (const char *)s.at : NULL;
}

/* Bounds of what is limited, with a text for each; origins of what is differentiated. */
static int read_limits(const ac_section *found, ac_unit *u) {
    ac_section bound = found[BOUNDS];
    const int32_t count = u->tape[AC_LIMITS].outputs, continuous = u->tape[AC_CONTINUOUS].outputs / 3;
    u->bound = ac_take(&bound, 3 * (int64_t)count, sizeof *u->bound);
    u->limited = texts(found[LIMITED], count);
    u->origin = texts(found[ORIGINS], continuous ? continuous + 1 : 0);
    return u->bound && !bound.left && u->limited && u->origin && u->tape[AC_CONTINUOUS].outputs == 3 * continuous;
}

static int read_numbers(const ac_section *found, ac_unit *u) {
    const ac_equations *e = &u->parts.model.equations;
    ac_section damped = found[DAMPED], nominal = found[NOMINAL], natural = found[NATURAL], token = found[TOKEN];
    u->damped = ac_take(&damped, e->nx, sizeof *u->damped);
    const double *span = ac_take(&nominal, 2, sizeof *span);
    u->nominal = ac_take(&nominal, (int64_t)e->nx + e->nz, sizeof *u->nominal);
    u->reach = ac_take(&nominal, e->nx, sizeof *u->reach);
    u->follows = ac_take(&nominal, e->nx, sizeof *u->follows);
    u->size = ac_take(&natural, e->nz, sizeof *u->size);
    if (!u->damped || !span || !u->nominal || !u->reach || !u->follows || !u->size || damped.left || nominal.left || natural.left) return 0;
    u->span = span[0], u->tolerance = span[1], u->token = (const char *)token.at;
    return positive(span, 2) && positive(u->damped, e->nx) && positive(u->nominal, e->nx + e->nz) && positive(u->reach, e->nx) && positive(u->follows, e->nx)
        && positive(u->size, e->nz) && token.at && token.left && !token.at[token.left - 1];
}

/* Whether a count of numbers fits in what is left of a section. */
static int counts(const double *count, const ac_section *s) {
    return count && *count >= 0 && *count <= (double)(s->left / sizeof *count) && *count == floor(*count);
}

/* Columns of tables: how many, then of each how many numbers, and these. Without the section they are those of this process. */
static int read_tables(ac_section s, ac_unit *u) {
    if (!s.at) return 1;
    const double *count = ac_take(&s, 1, sizeof *count);
    if (!counts(count, &s)) return 0;
    u->tables.count = (int32_t)*count;
    if (!(u->column = calloc((size_t)u->tables.count + 1, sizeof *u->column))) return 0;
    for (int32_t k = 0; k < u->tables.count; k++) {
        const double *numbers = u->column[k] = ac_take(&s, 1, sizeof *numbers);
        if (!counts(numbers, &s)) return 0;
        ac_take(&s, (int64_t)*numbers, sizeof *numbers);
    }
    u->tables.column = u->column;
    return !s.left;
}

/* Without columns of its own a unit has those of this process, to which later ones are added. */
static void bind_tables(ac_unit *u) {
    const ac_tables *tables = u->column || !ac_shared_tables() ? &u->tables : ac_shared_tables();
    for (int k = 0; k < AC_EQUATION_TAPES; k++) u->parts.tape[k].tables = tables;
    for (int k = 0; k < AC_TAPES; k++) u->tape[k].tables = tables;
    for (int k = 0; k < AC_SQUARES; k++) u->squared[k].tables = tables;
    for (int k = 0; k < AC_ROW_TAPES; k++) u->row_tape[k].tables = tables;
}

static int read_all(const ac_section *found, ac_unit *u) {
    return ac_read_parts(found, &u->parts) && !u->parts.model.equations.powers && read_layout(found, u) && read_tapes(found, u)
        && read_squares(found, u) && read_rules(found, u) && read_calls(found, u) && read_laws(found, u) && read_closing(found, u)
        && read_limits(found, u) && read_numbers(found, u) && read_tables(found[TABLES], u);
}

/* Read a unit; NULL where the bytes are none, and why. */
ac_unit *ac_unit_read(const void *bytes, size_t length, int32_t *why) {
    ac_section found[SECTIONS];
    if ((*why = ac_file_outside(bytes, length, VERSION)) != AC_READ) return NULL;
    ac_unit *u = malloc(sizeof *u + length);
    if (!u) {
        *why = AC_NO_MEMORY;
        return NULL;
    }
    memset(u, 0, sizeof *u);
    memcpy(u->file, bytes, length);
    if (ac_file_split((const unsigned char *)u->file, length, TAG, SECTIONS, found) && read_all(found, u)) {
        bind_tables(u);
        return u;
    }
    *why = AC_CONTENT;
    ac_unit_free(u);
    return NULL;
}

void ac_unit_free(ac_unit *unit) {
    if (unit) free(unit->column);
    free(unit);
}
