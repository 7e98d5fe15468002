/* Mesh, laws and linearised state that the kernels of the snow share. */
#ifndef NETDESIGN_ELEMENT_H
#define NETDESIGN_ELEMENT_H

#include "core.h"

enum { EDGE = 3, EDGE_POINTS = 4, PLANE = 3, MODULI = 6 };

/* A placed mesh, as ``PlacedMesh`` has it. */
typedef struct {
    int32_t n_nodes, n_triangles, n_net, n_edges;
    const int32_t *triangles;    /* (n_triangles, 6) */
    const int32_t *net;          /* (n_net,) */
    const int32_t *ground;       /* (2 n_edges + 1,) */
    const int32_t *edges;        /* (n_edges, 4): triangle, its nodes on the ground */
    const double *gradients;     /* (2, n_triangles, 3, 6), slope's axes */
    const double *weights;       /* (n_triangles, 3) */
    const double *axes;          /* (2, n_nodes) */
    const double *edge_weights;  /* (n_edges, 4) */
    const double *edge_shape;    /* (4, 3) */
    const double *load;          /* (2 n_nodes,): of gravity, node axes */
} Mesh;

/* Laws of creep and of a sliding ground; a stride is 0 where one number is all. */
typedef struct {
    double exponent, slip_exponent, floor;
    int32_t stride, slip_stride;
    const double *bulk, *fluidity; /* (n_triangles, 3), or one number */
    const double *slip;            /* (n_edges,), or one number */
} Law;

/* How snow is held: ``friction`` may be infinite. */
typedef struct {
    double friction;
    int32_t net_lets_go, ground_lets_go, holds_along; /* along: ground without slip */
    const uint8_t *may_lift; /* (2 n_edges,) */
} Rules;

/* Contact of the nodes above the foot and of the ground's but the foot. */
typedef struct {
    int64_t *sign;
    uint8_t *is_pressed, *is_open, *is_lifted;
} Contact;

/* What a step starts from, and what it finds. */
typedef struct {
    const double *stress;     /* (n_triangles, 3, 3) */
    const double *shear;      /* (n_edges, 4), or NULL where the ground does not slide */
    Contact contact;          /* under which the step is taken */
    double *unknowns, *reaction, *new_stress, *new_shear;
    double *root;             /* (2 n_net, 2 n_net), or NULL where nobody asks */
    double *moving;           /* (2 n_nodes,): velocities that unknowns are a change of,
                               * or NULL */
} Step;

/* Laws linearised at the points. */
typedef struct {
    double *moduli;      /* (n_triangles, 3, 6): upper triangles, row by row */
    double *intercept;   /* (n_triangles, 3, 3) */
    double *base_moduli, *base_intercept; /* (n_edges, 4) */
} Tangents;

/* Memory of a step, taken at once. */
typedef struct {
    Tangents tangents;
    double *blocks, *factor, *stack, *work, *load, *shares, *root;
    uint8_t *is_free, *bears;
    void *memory;
} Room;

double squared_invariant(const double *stress, double bulk);
void linearise(const Mesh *mesh, const Law *law, const Step *step,
               const uint8_t *bears, const Tangents *to);
void fill_blocks(const Mesh *mesh, const Tangents *of, int slides, double *blocks);
void add_forces(const Mesh *mesh, const double *stress, const double *shear,
                double *forces);
void advance(const Mesh *mesh, const Tangents *of, const Step *step);
int list_support(const Mesh *mesh, const Rules *rules, const Contact *contact,
                 uint8_t *is_free, double *shares, uint8_t *bears);
void update_contact(const Mesh *mesh, const Rules *rules, const Contact *from,
                    const double *velocity, const double *reaction, const Contact *to);
void change_some(const Mesh *mesh, const Contact *now, const Contact *wanted,
                 uint8_t *marks, int only_first);
int is_same(const Mesh *mesh, const Contact *one, const Contact *other);
void find_residual(const Mesh *mesh, const double *stress, const double *shear,
                   double *forces);
double compare_stress(const Mesh *mesh, const Law *law, const Step *step);
size_t lay_room(const Mesh *mesh, const int32_t *plan, double *memory, Room *room);
int open_room(const Mesh *mesh, const int32_t *plan, Room *room);
void set_up(const Mesh *mesh, const Law *law, const Step *step, const Room *room);
int take_step(const Mesh *mesh, const Law *law, const Rules *rules, const Step *step,
              const int32_t *plan, const Room *room);

#endif
