/* One Newton step of the flow of snow, eq. (N10). */
#include "element.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Digest of the text that this library was built from. */
EXPORT const char *nd_version(void) { return ND_VERSION; }

static size_t largest(size_t one, size_t other) { return one > other ? one : other; }

static int is_sound(const Mesh *mesh, const int32_t *plan) {
    return plan[MAGIC] == PLAN_MAGIC && plan[N_NODES] == mesh->n_nodes
           && plan[N_TRIANGLES] == mesh->n_triangles && plan[N_NET] == mesh->n_net;
}

/* Parts of the memory of a step; gives how many numbers it has, 0 for another mesh. */
size_t lay_room(const Mesh *mesh, const int32_t *plan, double *memory, Room *room) {
    if (!is_sound(mesh, plan)) return 0;
    size_t points = (size_t)POINTS * (size_t)mesh->n_triangles;
    size_t edges = (size_t)mesh->n_edges, edge_points = EDGE_POINTS * edges;
    size_t blocks = (size_t)UNKNOWNS * UNKNOWNS * (size_t)mesh->n_triangles;
    size_t factor = (size_t)plan[N_FACTOR], stack = (size_t)plan[N_STACK];
    size_t load = 2 * (size_t)mesh->n_nodes, net = 2 * (size_t)mesh->n_net;
    size_t work = largest((size_t)plan[WIDEST], net * (net + 2));
    size_t all = points * (MODULI + PLANE) + 2 * edge_points + blocks + factor + stack
                 + work + 2 * load + net * net;
    double *next = memory;
    all += (load + edges) / sizeof *next + 1; /* marks come last */
    if (!memory) return all;
    room->tangents.moduli = next;
    room->tangents.intercept = next += MODULI * points;
    room->tangents.base_moduli = next += PLANE * points;
    room->tangents.base_intercept = next += edge_points;
    room->blocks = next += edge_points;
    room->factor = next += blocks;
    room->stack = next += factor;
    room->work = next += stack;
    room->load = next += work;
    room->shares = next += load;
    room->root = next += load;
    room->is_free = (uint8_t *)(next + net * net);
    room->bears = room->is_free + load;
    return all;
}

/* Memory for steps on a mesh; whoever asks frees ``room->memory``. */
int open_room(const Mesh *mesh, const int32_t *plan, Room *room) {
    size_t count = lay_room(mesh, plan, NULL, room);
    if (!count) return BAD_INPUT;
    room->memory = malloc(count * sizeof(double));
    if (!room->memory) return NO_MEMORY;
    lay_room(mesh, plan, room->memory, room);
    return FINE;
}

/* Blocks, and the forces that are missing to balance, of the laws about a state: of snow
 * at rest, or of snow whose stresses a step begins with where its velocities lead to. */
void set_up(const Mesh *mesh, const Law *law, const Step *step, const Room *room) {
    int slides = step->shear != NULL;
    linearise(mesh, law, step, room->bears, &room->tangents);
    if (step->moving) {
        Step ahead = {.unknowns = step->moving, .shear = step->shear,
                      .new_stress = room->tangents.intercept,
                      .new_shear = room->tangents.base_intercept};
        advance(mesh, &room->tangents, &ahead);
    }
    fill_blocks(mesh, &room->tangents, slides, room->blocks);
    memset(room->load, 0, 2 * (size_t)mesh->n_nodes * sizeof *room->load);
    add_forces(mesh, room->tangents.intercept,
               slides ? room->tangents.base_intercept : NULL, room->load);
    for (int32_t i = 0; i < 2 * mesh->n_nodes; i++)
        room->load[i] = mesh->load[i] - room->load[i];
}

/* Newton step; with room for the root only that is found. Nothing is written where it
 * fails. */
int take_step(const Mesh *mesh, const Law *law, const Rules *rules, const Step *step,
              const int32_t *plan, const Room *room) {
    size_t count = 2 * (size_t)mesh->n_nodes;
    Factor to = {.plan = plan, .is_free = room->is_free, .factor = room->factor,
                 .load = room->load, .root = step->root ? step->root : room->root};
    int rubs = list_support(mesh, rules, &step->contact, room->is_free, room->shares,
                            room->bears);
    set_up(mesh, law, step, room);
    int fault = factor_fronts(&to, room->blocks, room->stack, room->work);
    if (fault || step->root) return fault; /* the root alone was asked for */
    fault = solve_root(&to, mesh->net, rubs ? room->shares : NULL, room->work);
    if (fault) return fault;
    solve_fronts(&to, room->work);
    memcpy(step->unknowns, room->load, count * sizeof *room->load);
    advance(mesh, &room->tangents, step);
    for (size_t i = 0; i < count; i++) step->reaction[i] = -mesh->load[i];
    add_forces(mesh, step->new_stress, step->new_shear, step->reaction);
    return FINE;
}

/* Internal less external nodal forces (2 n_nodes,) of stresses, and of shear on the
 * ground if it slides. */
void find_residual(const Mesh *mesh, const double *stress, const double *shear,
                   double *forces) {
    for (int32_t i = 0; i < 2 * mesh->n_nodes; i++) forces[i] = -mesh->load[i];
    add_forces(mesh, stress, shear, forces);
}
