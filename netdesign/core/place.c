/* All that depends on where the nodes of a mesh are.
 *
 * The kernels of snow/element.py (shape gradients) and snow/placed_mesh.py (normals of
 * the net, load). Theory: snow/THEORY.md, section 3. */
#include "round.h"

#include <math.h>
#include <string.h>

enum { SIDE = 3 };

/* Jacobian (reference direction, axis) at a point of a triangle. */
static void find_jacobian(const Placement *to, const int32_t *nodes, int q,
                          double jacobian[2][2]) {
    memset(jacobian, 0, 4 * sizeof(double));
    for (int i = 0; i < TRIANGLE; i++)
        for (int j = 0; j < 2; j++) {
            double slope = to->reference[(2 * i + j) * POINTS + q];
            jacobian[j][0] += to->nodes[nodes[i]] * slope;
            jacobian[j][1] += to->nodes[to->n_nodes + nodes[i]] * slope;
        }
}

static void place_point(const Placement *to, int32_t triangle, int q) {
    const int32_t *nodes = to->triangles + TRIANGLE * triangle;
    double jacobian[2][2];
    find_jacobian(to, nodes, q, jacobian);
    double determinant = jacobian[0][0] * jacobian[1][1] - jacobian[0][1] * jacobian[1][0];
    double weight = determinant * to->orientation[triangle] * to->point_weights[q];
    ptrdiff_t point = (ptrdiff_t)POINTS * triangle + q;
    double *dx = to->gradients + TRIANGLE * point;
    double *dy = dx + (ptrdiff_t)TRIANGLE * POINTS * to->n_triangles;
    to->weights[point] = weight;
    for (int i = 0; i < TRIANGLE; i++) {
        double first = to->reference[2 * i * POINTS + q];
        double second = to->reference[(2 * i + 1) * POINTS + q];
        dx[i] = (first * jacobian[1][1] - second * jacobian[0][1]) / determinant;
        dy[i] = (second * jacobian[0][0] - first * jacobian[1][0]) / determinant;
        to->load[nodes[i]] += weight * to->shape[TRIANGLE * q + i];
    }
}

/* Unit normals, each the normal integrated with the node's shape function. */
static void place_net(const Placement *to) {
    double *across = to->normal, *up = to->normal + to->n_net; /* first: tangents */
    memset(to->normal, 0, 2 * (size_t)to->n_net * sizeof *to->normal);
    for (int32_t first = 0; first + 2 < to->n_net; first += 2)
        for (int k = 0; k < SIDE; k++)
            for (int m = 0; m < SIDE; m++) {
                int32_t node = to->net[first + m];
                across[first + k] += to->nodes[node] * to->edge_tangent[SIDE * k + m];
                up[first + k] +=
                    to->nodes[to->n_nodes + node] * to->edge_tangent[SIDE * k + m];
            }
    for (int32_t i = 0; i < to->n_net; i++) {
        double size = hypot(across[i], up[i]), along = across[i] / size;
        across[i] = up[i] / size;
        up[i] = -along;
    }
}

/* Gradients, weights, load, axes and normals of placed nodes. */
void place_mesh(const Placement *to) {
    for (int32_t i = 0; i < to->n_nodes; i++) {
        to->load[i] = 0.0;
        to->axes[i] = 1.0;
        to->axes[to->n_nodes + i] = 0.0;
    }
    for (int32_t t = 0; t < to->n_triangles; t++)
        for (int q = 0; q < POINTS; q++) place_point(to, t, q);
    place_net(to);
    for (int32_t i = 1; i < to->n_net; i++) { /* the foot is held in both directions */
        to->axes[to->net[i]] = to->normal[i];
        to->axes[to->n_nodes + to->net[i]] = to->normal[to->n_net + i];
    }
}
