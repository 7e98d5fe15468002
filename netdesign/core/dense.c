/* Small dense equations: the same as those of LAPACK in NumPy, but for rounding. */
#include "core.h"

#include <math.h>

/* Rows exchanged for the largest pivot, then triangular factors in place. */
int factor_dense(int32_t n, double *matrix, int32_t *order) {
    for (int32_t k = 0; k < n; k++) {
        int32_t best = k;
        for (int32_t i = k + 1; i < n; i++)
            if (fabs(matrix[i * n + k]) > fabs(matrix[best * n + k])) best = i;
        order[k] = best;
        for (int32_t j = 0; best != k && j < n; j++) {
            double held = matrix[k * n + j];
            matrix[k * n + j] = matrix[best * n + j];
            matrix[best * n + j] = held;
        }
        double pivot = matrix[k * n + k];
        if (pivot == 0.0 || !isfinite(pivot)) return SINGULAR;
        for (int32_t i = k + 1; i < n; i++) {
            double share = matrix[i * n + k] /= pivot;
            for (int32_t j = k + 1; j < n; j++)
                matrix[i * n + j] -= share * matrix[k * n + j];
        }
    }
    return FINE;
}

/* Solution of the factored equations in place; gives its norm. */
double solve_factored(int32_t n, const double *matrix, const int32_t *order,
                      double *values) {
    double square = 0.0;
    for (int32_t k = 0; k < n; k++) {
        double held = values[order[k]];
        values[order[k]] = values[k];
        values[k] = held;
    }
    for (int32_t k = 0; k < n; k++)
        for (int32_t j = 0; j < k; j++) values[k] -= matrix[k * n + j] * values[j];
    for (int32_t k = n - 1; k >= 0; k--) {
        for (int32_t j = k + 1; j < n; j++) values[k] -= matrix[k * n + j] * values[j];
        values[k] /= matrix[k * n + k];
        square += values[k] * values[k];
    }
    return sqrt(square);
}
