/* Parts of a round of flow and net. */
#ifndef NETDESIGN_ROUND_H
#define NETDESIGN_ROUND_H

#include "element.h"

/* What the core is given to place a mesh, and where it puts the results. */
typedef struct {
    int32_t n_nodes, n_triangles, n_net;
    const int32_t *triangles, *net; /* (n_triangles, 6), (n_net,) */
    const double *orientation;      /* (n_triangles,): 1 or -1 */
    const double *reference;        /* (6, 2, 3): gradients of shape functions */
    const double *shape;            /* (3, 6) */
    const double *point_weights;    /* (3,) */
    const double *edge_tangent;     /* (3, 3): node, coefficient of an edge's node */
    const double *nodes;            /* (2, n_nodes) */
    double *gradients, *weights;    /* (2, n_triangles, 3, 6), (n_triangles, 3) */
    double *load, *axes, *normal;   /* (n_nodes,), (2, n_nodes), (2, n_net) */
} Placement;

/* An iterate of the flow: where it starts, and where it ends. */
typedef struct {
    double *numbers; /* unknowns, reactions (2 n_nodes,), stress, then shear if any */
    Contact contact; /* under which it was found */
    int32_t slides;
} State;

/* What is asked of a flow, and what it took. */
typedef struct {
    double tolerance, linear_part, square_factor, field_weight; /* as in snow/flow.py */
    int32_t most_steps, patience;
    int32_t steps; /* taken, with the first */
    double change; /* that the last one left */
} Effort;

enum { CONVERGED = 0, GAVE_UP = 1, NOT_FINITE = 2 }; /* how a flow ends */
enum { OPEN = 1 };                                   /* a net without equilibrium */

EXPORT int32_t nd_place(const Placement *to);
EXPORT int32_t nd_flow(const Mesh *mesh, const Law *law, const Law *first,
                       const Rules *rules, const int32_t *plan, const State *state,
                       Effort *effort);
EXPORT int32_t nd_hang(int32_t n, const double *forces, const double *lengths,
                       double stiffness, const double *head, double tolerance,
                       double *pull, double *curve, double *tension, double *ends);
EXPORT int32_t nd_part(int32_t n, int32_t n_parts, const double *forces,
                       const double *shares, const int64_t *firsts, const double *rises,
                       double head_x, double length, double stiffness, double *pull,
                       double *lengths);

#endif
