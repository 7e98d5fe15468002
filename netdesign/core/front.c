/* Multifrontal Cholesky factor of element blocks, and its dense root.
 *
 * Theory: core/THEORY.md, section 2. Blocks are symmetric, (12, 12), two velocities for
 * each of a triangle's nodes. Upper triangles of fronts are kept, row by row. */
#include "core.h"

#include <math.h>
#include <string.h>

enum { PANEL = 8 }; /* pivots that are eliminated together, 2 to the power of 3 */

typedef struct {
    int32_t pivots, size, left;   /* unknowns: eliminated here, all, the others */
    const int32_t *nodes, *map;   /* (size / 2,), and of the others in the parent */
    const int32_t *leaf;          /* triangles with their places */
    int32_t n_leaf, span;
} Front;

static Front open_front(const int32_t *plan, int32_t number) {
    const int32_t *record = plan + HEAD + RECORD * number;
    Front front = {.pivots = 2 * record[PIVOTS], .size = 2 * record[SIZE],
                   .nodes = plan + record[START], .n_leaf = record[N_LEAF],
                   .span = record[SPAN]};
    front.left = front.size - front.pivots;
    front.map = front.nodes + record[SIZE];
    front.leaf = front.map + (record[SIZE] - record[PIVOTS]);
    return front;
}

/* Row of a front so that row[j] is its entry in column j: rows of pivots are in the
 * factor, the others in what is left for the parent. */
static inline double *row_of(const Front *front, double *factor, double *update,
                             int32_t i) {
    if (i < front->pivots) return factor + (ptrdiff_t)i * front->size;
    return update + (ptrdiff_t)(i - front->pivots) * front->left - front->pivots;
}

WIDE static void add_block(const Front *front, double *factor, double *update,
                      const int32_t *place, const double *block) {
    for (int a = 0; a < TRIANGLE; a++) {
        double *first = row_of(front, factor, update, 2 * place[a]);
        double *second = row_of(front, factor, update, 2 * place[a] + 1);
        const double *from = block + 2 * UNKNOWNS * a;
        for (int b = 0; b < TRIANGLE; b++) {
            if (place[b] < place[a]) continue;
            int32_t j = 2 * place[b];
            first[j] += from[2 * b];
            first[j + 1] += from[2 * b + 1];
            second[j] += from[UNKNOWNS + 2 * b];
            second[j + 1] += from[UNKNOWNS + 2 * b + 1];
        }
    }
}

/* Adds what a child has left. */
WIDE static void add_child(const Front *front, double *factor, double *update,
                      const Front *child, const double *given) {
    int32_t count = child->left / 2;
    for (int32_t a = 0; a < child->left; a++) {
        double *row = row_of(front, factor, update, 2 * child->map[a / 2] + a % 2);
        const double *from = given + (ptrdiff_t)a * child->left;
        for (int32_t b = a / 2; b < count; b++) {
            int32_t j = 2 * child->map[b];
            row[j] += from[2 * b];
            row[j + 1] += from[2 * b + 1];
        }
    }
}

/* Divides the row of a pivot by its root; a held unknown leaves nothing. */
static inline int scale_row(double *row, double *load, int32_t k, int32_t size, int is_free) {
    if (!is_free) {
        memset(row + k, 0, (size_t)(size - k) * sizeof *row);
        load[k] = 0.0;
        return FINE;
    }
    if (!(row[k] > 0.0) || !isfinite(row[k])) return SINGULAR;
    double inverse = 1.0 / sqrt(row[k]);
    for (int32_t j = k + 1; j < size; j++) row[j] *= inverse;
    load[k] *= inverse;
    row[k] = inverse;
    return FINE;
}

static inline void take(double *restrict row, const double *restrict pivot, double by,
                        int32_t from, int32_t to) {
    for (int32_t j = from; j < to; j++) row[j] -= by * pivot[j];
}

/* Takes the products of some rows of pivots at once: the row is read less often. */
static inline void take_two(double *restrict row, double *const *pivot, int32_t i,
                            int32_t to) {
    const double *restrict p = pivot[0], *restrict q = pivot[1];
    double a = p[i], b = q[i];
    for (int32_t j = i; j < to; j++) row[j] = (row[j] - a * p[j]) - b * q[j];
}

static inline void take_four(double *restrict row, double *const *pivot, int32_t i,
                             int32_t to) {
    const double *restrict p = pivot[0], *restrict q = pivot[1];
    const double *restrict r = pivot[2], *restrict s = pivot[3];
    double a = p[i], b = q[i], c = r[i], d = s[i];
    for (int32_t j = i; j < to; j++)
        row[j] = (((row[j] - a * p[j]) - b * q[j]) - c * r[j]) - d * s[j];
}

static inline void take_eight(double *restrict row, double *const *pivot, int32_t i,
                              int32_t to) {
    const double *restrict p = pivot[0], *restrict q = pivot[1];
    const double *restrict r = pivot[2], *restrict s = pivot[3];
    const double *restrict t = pivot[4], *restrict u = pivot[5];
    const double *restrict v = pivot[6], *restrict w = pivot[7];
    double a = p[i], b = q[i], c = r[i], d = s[i];
    double e = t[i], f = u[i], g = v[i], h = w[i];
    for (int32_t j = i; j < to; j++)
        row[j] = (((((((row[j] - a * p[j]) - b * q[j]) - c * r[j]) - d * s[j])
                    - e * t[j]) - f * u[j]) - g * v[j]) - h * w[j];
}

/* Takes an even number of pivots from a row. */
static inline void take_pivots(double *restrict row, double *const *pivot, int32_t count,
                               int32_t i, int32_t to) {
    if (count == PANEL) {
        take_eight(row, pivot, i, to);
        return;
    }
    if (count & 4) take_four(row, pivot, i, to);
    if (count & 2) take_two(row, pivot + (count & 4), i, to);
}

/* Eliminates a few pivots within their own rows. */
WIDE static int eliminate_panel(const Front *front, double *const *pivot, double *load,
                                int32_t k, int32_t count, const uint8_t *is_free) {
    for (int32_t c = 0; c < count; c++) {
        take_pivots(pivot[c], pivot, c & ~1, k + c, front->size);
        if (c & 1) take(pivot[c], pivot[c - 1], pivot[c - 1][k + c], k + c, front->size);
        for (int32_t e = 0; e < c; e++) load[k + c] -= pivot[e][k + c] * load[k + e];
        int32_t unknown = 2 * front->nodes[(k + c) / 2] + (k + c) % 2;
        if (scale_row(pivot[c], load, k + c, front->size, is_free[unknown]))
            return SINGULAR;
    }
    return FINE;
}

/* Eliminates the pivots of a front, which are even in number. */
WIDE static int eliminate(const Front *front, double *factor, double *update, double *load,
                     const uint8_t *is_free) {
    for (int32_t k = 0; k < front->pivots; k += PANEL) {
        int32_t count = front->pivots - k < PANEL ? front->pivots - k : PANEL;
        double *pivot[PANEL] = {NULL};
        for (int32_t c = 0; c < count; c++)
            pivot[c] = row_of(front, factor, update, k + c);
        if (eliminate_panel(front, pivot, load, k, count, is_free)) return SINGULAR;
        for (int32_t i = k + count; i < front->size; i++) {
            for (int32_t c = 0; c < count; c++) load[i] -= pivot[c][i] * load[k + c];
            double *row = row_of(front, factor, update, i);
            take_pivots(row, pivot, count, i, front->size);
        }
    }
    return FINE;
}

static void fetch(const Front *front, const double *all, double *own) {
    for (int32_t i = 0; i < front->size / 2; i++) {
        own[2 * i] = all[2 * front->nodes[i]];
        own[2 * i + 1] = all[2 * front->nodes[i] + 1];
    }
}

static void put_back(const Front *front, double *all, const double *own, int32_t count) {
    for (int32_t i = 0; i < count / 2; i++) {
        all[2 * front->nodes[i]] = own[2 * i];
        all[2 * front->nodes[i] + 1] = own[2 * i + 1];
    }
}

static void fill_root(const Factor *to, const Front *last, const double *given) {
    int32_t width = 2 * to->plan[N_NET];
    memset(to->root, 0, (size_t)width * (size_t)width * sizeof *to->root);
    for (int32_t a = 0; a < last->left; a++)
        for (int32_t b = a; b < last->left; b++) {
            int32_t i = 2 * last->map[a / 2] + a % 2, j = 2 * last->map[b / 2] + b % 2;
            to->root[i * width + j] = to->root[j * width + i] = given[a * last->left + b];
        }
}

/* Factor and forward sweep; ``stack`` and ``work`` as large as the plan says. */
int factor_fronts(const Factor *to, const double *blocks, double *stack, double *work) {
    double *factor = to->factor, *top = stack, *load = work;
    Front front = {0};
    for (int32_t number = 0; number < to->plan[N_FRONTS]; number++) {
        front = open_front(to->plan, number);
        double *update = top;
        size_t kept = (size_t)front.pivots * (size_t)front.size;
        size_t left = (size_t)front.left * (size_t)front.left;
        memset(factor, 0, kept * sizeof *factor);
        memset(update, 0, left * sizeof *update);
        for (int32_t i = 0; i < front.n_leaf; i++) {
            const int32_t *words = front.leaf + (1 + TRIANGLE) * i;
            add_block(&front, factor, update, words + 1,
                      blocks + (ptrdiff_t)words[0] * UNKNOWNS * UNKNOWNS);
        }
        for (int32_t i = 0; i < 2 && front.span > 0; i++) {
            Front child = open_front(to->plan, number - 1 - i * front.span);
            top -= (ptrdiff_t)child.left * child.left;
            add_child(&front, factor, update, &child, top);
        }
        fetch(&front, to->load, load);
        if (eliminate(&front, factor, update, load, to->is_free)) return SINGULAR;
        put_back(&front, to->load, load, front.size);
        memmove(top, update, left * sizeof *top);
        top += left;
        factor += kept;
    }
    fill_root(to, &front, stack);
    return FINE;
}

/* Product of two rows in four sums side by side. */
static double multiply(const double *one, const double *other, int32_t count) {
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    int32_t j = 0;
    for (; j + 4 <= count; j += 4)
        for (int k = 0; k < 4; k++) sum[k] += one[j + k] * other[j + k];
    for (; j < count; j++) sum[0] += one[j] * other[j];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Solution of the fronts' unknowns once the root's are known. */
void solve_fronts(const Factor *to, double *work) {
    const double *factor = to->factor + to->plan[N_FACTOR];
    for (int32_t number = to->plan[N_FRONTS] - 1; number >= 0; number--) {
        Front front = open_front(to->plan, number);
        factor -= (ptrdiff_t)front.pivots * front.size;
        fetch(&front, to->load, work);
        for (int32_t k = front.pivots - 1; k >= 0; k--) {
            const double *row = factor + (ptrdiff_t)k * front.size;
            double known = multiply(row + k + 1, work + k + 1, front.size - k - 1);
            work[k] = (work[k] - known) * row[k]; /* inverse pivot, 0 where held */
        }
        put_back(&front, to->load, work, front.pivots);
    }
}

/* Rows of what is free in the root, friction added; its right side is column n. */
static int32_t fill_free(const Factor *to, const int32_t *net, const double *shares,
                         int32_t *unknown, double *matrix) {
    int32_t width = 2 * to->plan[N_NET], n = 0;
    for (int32_t i = 0; i < width; i++)
        if (to->is_free[2 * net[i / 2] + i % 2]) unknown[n++] = i;
    for (int32_t a = 0; a < n; a++) {
        int32_t i = unknown[a], at = 2 * net[i / 2] + i % 2;
        double share = shares && i % 2 ? shares[at] : 0.0;
        const double *row = to->root + (ptrdiff_t)i * width;
        double *own = matrix + (ptrdiff_t)a * (n + 1);
        for (int32_t b = 0; b < n; b++) own[b] = row[unknown[b]];
        own[n] = to->load[at];
        if (share == 0.0) continue;
        for (int32_t b = 0; b < n; b++) own[b] += share * row[unknown[b] - width];
        own[n] += share * to->load[at - 1];
    }
    return n;
}

static int find_pivot(double *matrix, int32_t n, int32_t k, int is_symmetric) {
    int32_t best = k, width = n + 1;
    if (is_symmetric) return matrix[k * width + k] > 0.0 ? FINE : SINGULAR;
    for (int32_t i = k + 1; i < n; i++)
        if (fabs(matrix[i * width + k]) > fabs(matrix[best * width + k])) best = i;
    if (!(fabs(matrix[best * width + k]) > 0.0)) return SINGULAR;
    for (int32_t j = k; j < width && best != k; j++) {
        double kept = matrix[k * width + j];
        matrix[k * width + j] = matrix[best * width + j];
        matrix[best * width + j] = kept;
    }
    return FINE;
}

/* Solution of n equations in place of their right side, column n. Without friction they
 * are symmetric and positive definite, else their rows are exchanged. */
static int solve_dense(double *matrix, int32_t n, int is_symmetric) {
    int32_t width = n + 1;
    for (int32_t k = 0; k < n; k++) {
        if (find_pivot(matrix, n, k, is_symmetric)) return SINGULAR;
        const double *pivot = matrix + (ptrdiff_t)k * width;
        for (int32_t i = k + 1; i < n; i++) {
            double *row = matrix + (ptrdiff_t)i * width;
            take(row, pivot, row[k] / pivot[k], k, width);
        }
    }
    for (int32_t k = n - 1; k >= 0; k--) {
        double *row = matrix + (ptrdiff_t)k * width;
        for (int32_t j = k + 1; j < n; j++) row[n] -= row[j] * matrix[j * width + n];
        row[n] /= row[k];
    }
    return FINE;
}

/* Unknowns of the net's nodes; ``shares`` is NULL without friction. ``work`` has room
 * for (2 n_net) (2 n_net + 2) numbers. */
int solve_root(const Factor *to, const int32_t *net, const double *shares,
               double *work) {
    int32_t width = 2 * to->plan[N_NET];
    int32_t *unknown = (int32_t *)(work + (ptrdiff_t)width * (width + 1));
    int32_t n = fill_free(to, net, shares, unknown, work);
    if (solve_dense(work, n, shares == NULL)) return SINGULAR;
    for (int32_t i = 0; i < width; i++) to->load[2 * net[i / 2] + i % 2] = 0.0;
    for (int32_t a = 0; a < n; a++) {
        int32_t i = unknown[a];
        to->load[2 * net[i / 2] + i % 2] = work[a * (n + 1) + n];
    }
    return FINE;
}
