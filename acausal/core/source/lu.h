/* What the two parts of the LU share. */
#ifndef ACAUSAL_LU_H
#define ACAUSAL_LU_H

#include "core.h"

struct ac_lu {
    int32_t n, ready, known;               /* whether there are pivots, and values for which they were chosen */
    int32_t odd;                           /* whether the steps permute rows and columns by an odd number of exchanges */
    int32_t *start, *row;                  /* of the matrix */
    int32_t *row_of, *column_of, *step_of; /* row and column of each step, step of each row */
    double *scale, *inverse, *work;        /* inverse of each pivot */
    int32_t *step;                         /* of each entry of the matrix, the step that takes its row, */
    double *factor;                        /* and the scale of that */
    double *given;                         /* the values for which pivots were chosen */
    double most;                           /* growth of the factors at which they are chosen anew */
    int32_t *l_start, *l_row, *u_start, *u_row; /* both factors in columns: what eliminates runs through them, */
    int32_t *l_in, *l_column, *u_in, *u_column; /* and in rows, where each begins, those of U from its last column on: what solves */
    int32_t *l_place, *u_place;                 /* of each entry of a column, its place in rows */
    double *l, *l_rows, *u_rows;
    int32_t l_room, u_room;
    int64_t chosen, factored, flops;
};

int32_t ac_lu_take(ac_lu *lu, const double *value, double enough, const int32_t *row, const int32_t *column);
void ac_lu_renew(ac_lu *lu);
void ac_lu_lose(ac_lu *lu, double part);
int ac_lu_again(ac_lu *lu, const double *value);
double ac_lu_least(ac_lu *lu);
int32_t ac_is_odd(int32_t n, const int32_t *to, int32_t *seen);
int ac_lu_is_negative(const ac_lu *lu);
int32_t ac_lu_choose(ac_lu *lu, const double *value, double enough);
size_t ac_lu_order_size(const ac_lu *lu);
void ac_lu_order(const ac_lu *lu, double *order);
int ac_lu_reorder(ac_lu *lu, const double *order);
void ac_lu_solve_transposed(ac_lu *lu, double *b);

#endif
