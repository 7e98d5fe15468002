/* Compiled core: kernels of the steady state. Theory: core/THEORY.md.
 *
 * Every function is a kernel that a Python module of the program has in NumPy, too; the
 * NumPy text is the truth. Nothing is kept between calls. Arrays come from the caller,
 * C-contiguous; results are written where the caller says. */
#ifndef NETDESIGN_CORE_H
#define NETDESIGN_CORE_H

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#define EXPORT __attribute__((visibility("default")))

/* A second text of a function for processors with wider registers: the same operations in
 * the same order, so the same digits. Only where the linker can choose. */
#if defined(__x86_64__) && defined(__gnu_linux__) && defined(__GLIBC__) \
    && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define WIDE __attribute__((target_clones("avx2", "default")))
#else
#define WIDE
#endif

enum { FINE = 0, NO_MEMORY = -1, BAD_INPUT = -2, SINGULAR = -3, TOO_LARGE = -4 };
enum { TRIANGLE = 6, UNKNOWNS = 12, POINTS = 3 }; /* nodes, velocities, points */

/* Words at the head of a plan, and of the record of each of its fronts. */
enum {
    MAGIC, N_NODES, N_TRIANGLES, N_NET, N_FRONTS, WIDEST, N_FACTOR, N_STACK, N_WORDS,
    HEAD
};
enum { PIVOTS, SIZE, SPAN, N_LEAF, START, RECORD }; /* SPAN: fronts of a half */
enum { PLAN_MAGIC = 0x6e647031 };

/* Sparse factor of one matrix; what dense root it leaves (front.c). */
typedef struct {
    const int32_t *plan;
    const uint8_t *is_free; /* (2 n_nodes,) */
    double *factor;         /* rows of the factor, front by front */
    double *load;           /* (2 n_nodes,): right side, then solution */
    double *root;           /* (2 n_net, 2 n_net), symmetric, whole */
} Factor;

int factor_fronts(const Factor *to, const double *blocks, double *stack, double *work);
void solve_fronts(const Factor *to, double *work);
int solve_root(const Factor *to, const int32_t *net, const double *shares,
               double *work);
int factor_dense(int32_t n, double *matrix, int32_t *order);
double solve_factored(int32_t n, const double *matrix, const int32_t *order,
                      double *values);

#endif
