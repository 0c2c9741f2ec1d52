/* carom in Fluent: what happens to a particle at a wall, by a wall law for each zone. How to build and hook it: ../README.md
 *
 *   carom_loading   reads and checks the table when the library is loaded
 *   carom_wall      the boundary condition (Boundary Conditions > DPM > user_defined)
 *   carom_accretion accretion rates of what sticks (Discrete Phase > UDF > Erosion/Accretion)
 *   carom_spin      starts particles without spin (Discrete Phase > UDF > Scalar Update); needed with `spin`
 *   carom_reload, carom_report, carom_reset   on demand */
#include "udf.h"

#include "carom_walls.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Fluent has called these macros P_... and then, for particles under way, TP_... */
#ifdef TP_VEL
#define PARTICLE_VEL(p) TP_VEL(p)
#define PARTICLE_VEL0(p) TP_VEL0(p)
#define PARTICLE_POS(p) TP_POS(p)
#define PARTICLE_DIAM(p) TP_DIAM(p)
#define PARTICLE_RHO(p) TP_RHO(p)
#define PARTICLE_MASS(p) TP_MASS(p)
#define PARTICLE_N(p) TP_N(p)
#define PARTICLE_FLOW_RATE(p) TP_FLOW_RATE(p)
#define PARTICLE_TIME(p) TP_TIME(p)
#define PARTICLE_USER_REAL(p, i) TP_USER_REAL(p, i)
#define PARTICLE_ID(p) TP_ID(p)
#else
#define PARTICLE_VEL(p) P_VEL(p)
#define PARTICLE_VEL0(p) P_VEL0(p)
#define PARTICLE_POS(p) P_POS(p)
#define PARTICLE_DIAM(p) P_DIAM(p)
#define PARTICLE_RHO(p) P_RHO(p)
#define PARTICLE_MASS(p) P_MASS(p)
#define PARTICLE_N(p) P_N(p)
#define PARTICLE_FLOW_RATE(p) P_FLOW_RATE(p)
#define PARTICLE_TIME(p) P_TIME(p)
#define PARTICLE_USER_REAL(p, i) P_USER_REAL(p, i)
#define PARTICLE_ID(p) ((p)->part_id)
#endif

/* How the path of a captured particle ends. */
#ifndef CAROM_CAPTURED
#define CAROM_CAPTURED PATH_ABORT
#endif

static carom_walls walls;
static int ready;
static char trouble[4096] = "carom: the table of zones has not been read; load the library again or run carom_reload";

/* Adds to a number that other threads of this process may add to as well. */
#if defined(__GNUC__)
#define ADD(type, target, value)                                                                         \
    do {                                                                                                 \
        type there_, sum_;                                                                               \
        __atomic_load((target), &there_, __ATOMIC_RELAXED);                                              \
        do {                                                                                             \
            sum_ = there_ + (value);                                                                     \
        } while (!__atomic_compare_exchange((target), &there_, &sum_, 1, __ATOMIC_RELAXED, __ATOMIC_RELAXED)); \
    } while (0)
#else
#define ADD(type, target, value) (*(target) += (value))
#endif

#if !RP_HOST

/* Every zone of the table must be one of the case, where a mesh has been read already. */
static int zones_exist(void)
{
    Domain *domain = Get_Domain(1);
    Thread *t;
    size_t i;
    int any = 0, found;

    if (domain == NULL) {
        return 1;
    }
    for (i = 0; i < walls.n; i++) {
        found = 0;
        thread_loop_f(t, domain)
        {
            any = 1;
            found |= THREAD_ID(t) == walls.zones[i].id;
        }
        if (any && !found) {
            snprintf(trouble, sizeof trouble, "carom: %s:%d: zone %d (%s) is no zone of this case", walls.file,
                     walls.zones[i].line, walls.zones[i].id, walls.zones[i].name);
            return 0;
        }
    }
    return 1;
}

static int memory_is_there(void)
{
#ifdef N_UDM
    if (walls.deposit != CAROM_DEPOSIT_NONE && walls.memory + 2 > N_UDM) {
        snprintf(trouble, sizeof trouble, "carom: %s: deposit %s %d needs %d user-defined memories; the case has %d",
                 walls.file, walls.deposit == CAROM_DEPOSIT_MASS ? "mass" : "rate", walls.memory, walls.memory + 2, N_UDM);
        return 0;
    }
#endif
    return 1;
}

static void load(void)
{
    const char *path = getenv("CAROM_WALLS");
    const size_t prefix = strlen("carom: ");

    if (ready) {
        carom_walls_free(&walls);
    }
    ready = 0;
    strcpy(trouble, "carom: ");
    if (carom_walls_read(&walls, path != NULL && path[0] != '\0' ? path : "carom-walls.txt", CAROM_ZONES_BY_ID,
                         trouble + prefix, sizeof trouble - prefix) != 0) {
        Error("%s\n", trouble);
        return;
    }
    if (!zones_exist() || !memory_is_there()) {
        carom_walls_free(&walls);
        Error("%s\n", trouble);
        return;
    }
    ready = 1;
    Message0("\ncarom %s: %d zone(s) with wall laws from %s\n", carom_version(), (int)walls.n, walls.file);
}

/* The zone of a face; NULL, after an error, if there is none. */
static carom_wall_zone *zone_of(Thread *t)
{
    carom_wall_zone *zone;

    if (!ready) {
        Error("%s\n", trouble);
        return NULL;
    }
    zone = carom_walls_find(&walls, (int)THREAD_ID(t));
    if (zone == NULL) {
        Error("carom: zone %d has carom_wall as its condition but no entry in %s; add: zone %d NAME FILE:LAW\n",
              (int)THREAD_ID(t), walls.file, (int)THREAD_ID(t));
    }
    return zone;
}

/* The face's normal as the particle sees it, in as many dimensions as it moves in: with swirl a two-dimensional case is tracked in
   three, and the normal lies in the particle's own meridional plane. */
static int normal_at(Tracked_Particle *p, const real f_normal[], int dim, double normal[3])
{
    int i;

    normal[2] = 0.0;
#if RP_2D
    if (rp_axi_swirl) {
        const double y = PARTICLE_POS(p)[1], z = PARTICLE_POS(p)[2], r = sqrt(y * y + z * z);
        if (r > 1e-20) {
            normal[0] = f_normal[0];
            normal[1] = f_normal[1] * y / r;
            normal[2] = f_normal[1] * z / r;
            return 3;
        }
    }
#else
    (void)p;
#endif
    for (i = 0; i < dim; i++) {
        normal[i] = f_normal[i];
    }
    return dim;
}

/* From the particle and the place and time of its impact: the same on any node, and for carom_accretion. */
static void draw(Tracked_Particle *p, int dim, double draws[4])
{
    double numbers[4];
    int i;

    for (i = 0; i < dim; i++) {
        numbers[i] = PARTICLE_POS(p)[i];
    }
    numbers[dim] = PARTICLE_TIME(p);
    carom_walls_draw((uint64_t)PARTICLE_ID(p), numbers, dim + 1, draws);
}

static double amount(Tracked_Particle *p)
{
    return walls.deposit == CAROM_DEPOSIT_RATE ? (double)PARTICLE_FLOW_RATE(p)
                                               : (double)PARTICLE_N(p) * (double)PARTICLE_MASS(p);
}

static double area_of(face_t f, Thread *t)
{
    real area[ND_ND];

    F_AREA(area, f, t);
    return NV_MAG(area);
}

/* Deposit per area and number of impacts, in the cell at the wall. */
static void remember(Tracked_Particle *p, face_t f, Thread *t, carom_wall_zone *zone, int captured)
{
    if (captured) {
        const double more = amount(p);
        ADD(int, &zone->captures, 1);
        ADD(double, &zone->captured, more);
    } else {
        ADD(int, &zone->rebounds, 1);
    }
    if (walls.deposit != CAROM_DEPOSIT_NONE) {
        const cell_t c = F_C0(f, t);
        Thread *cells = THREAD_T0(t);
        if (captured) {
            const real more = (real)(amount(p) / area_of(f, t));
            ADD(real, &C_UDMI(c, cells, walls.memory), more);
        }
        ADD(real, &C_UDMI(c, cells, walls.memory + 1), (real)1);
    }
}

/* The impact, told to carom. Whichever way the face's normal points, the particle came from the other side of the wall. */
static int impact_of(Tracked_Particle *p, const carom_wall_zone *zone, const real f_normal[], int dim, carom_impact_in *in)
{
    double outward[3], approach = 0.0;
    const int n = normal_at(p, f_normal, dim, outward);
    int i;

    memset(in, 0, sizeof *in);
    in->size = sizeof *in;
    in->diameter = PARTICLE_DIAM(p);
    in->density = PARTICLE_RHO(p);
    for (i = 0; i < n; i++) {
        in->velocity[i] = PARTICLE_VEL(p)[i];
        in->wall_velocity[i] = zone->velocity[i];
        approach += (in->velocity[i] - in->wall_velocity[i]) * outward[i];
    }
    for (i = 0; i < 3; i++) {
        in->normal[i] = approach > 0.0 ? -outward[i] : outward[i];
        in->spin[i] = walls.spin >= 0 ? (double)PARTICLE_USER_REAL(p, walls.spin + i) : 0.0;
    }
    draw(p, n, in->draws);
    return n;
}

static void leave(Tracked_Particle *p, const carom_impact_out *out, int n)
{
    int i;

    for (i = 0; i < n; i++) {
        PARTICLE_VEL(p)[i] = PARTICLE_VEL0(p)[i] = (real)out->velocity[i];
    }
    for (i = 0; walls.spin >= 0 && i < 3; i++) {
        PARTICLE_USER_REAL(p, walls.spin + i) = (real)out->spin[i];
    }
}

#endif /* !RP_HOST */

DEFINE_EXECUTE_ON_LOADING(carom_loading, libname)
{
    (void)libname;
#if !RP_HOST
    load();
#endif
}

DEFINE_ON_DEMAND(carom_reload)
{
#if !RP_HOST
    load();
#endif
}

DEFINE_DPM_BC(carom_wall, p, t, f, f_normal, dim)
{
#if !RP_HOST
    carom_wall_zone *zone = zone_of(t);
    carom_impact_in in;
    carom_impact_out out;
    carom_status status;
    int n;

    if (zone == NULL) {
        return PATH_ABORT;
    }
    if (zone->kind != CAROM_WALL_LAW) {
        if (zone->kind == CAROM_WALL_TRAP) {
            remember(p, f, t, zone, 1);
        }
        return zone->kind == CAROM_WALL_TRAP ? CAROM_CAPTURED : PATH_END;
    }
    n = impact_of(p, zone, f_normal, dim, &in);
    out.size = sizeof out;
    status = carom_impact(zone->law, &in, &out);
    if (status == CAROM_STATUS_NOT_APPROACHING) {
        return PATH_ACTIVE; /* it glides along the wall */
    }
    if (status != CAROM_STATUS_OK) {
        Error("carom: zone %d (%s): %s\n", zone->id, zone->name, carom_last_error());
        return PATH_ABORT;
    }
    leave(p, &out, n);
    remember(p, f, t, zone, out.fate == CAROM_FATE_CAPTURE);
    return out.fate == CAROM_FATE_CAPTURE ? CAROM_CAPTURED : PATH_ACTIVE;
#else
    return PATH_ABORT;
#endif
}

/* Fluent zeroes the storage at each update and divides nothing by areas. Speed and angle are those of the particle as it came, whether
   carom_wall was called before or not. */
DEFINE_DPM_EROSION(carom_accretion, p, t, f, normal, alpha, Vmag, mdot)
{
#if !RP_HOST
    carom_wall_zone *zone = zone_of(t);
    carom_impact_in in;
    carom_impact_out out;
    double outward[3];
    int captured;

    if (zone == NULL) {
        return;
    }
    captured = zone->kind == CAROM_WALL_TRAP;
    if (zone->kind == CAROM_WALL_LAW) {
        memset(&in, 0, sizeof in);
        in.size = sizeof in;
        out.size = sizeof out;
        in.diameter = PARTICLE_DIAM(p);
        in.density = PARTICLE_RHO(p);
        in.velocity[0] = Vmag * cos(alpha);
        in.velocity[1] = -Vmag * sin(alpha);
        in.normal[1] = 1.0;
        draw(p, normal_at(p, normal, ND_ND, outward), in.draws);
        captured = carom_impact(zone->law, &in, &out) == CAROM_STATUS_OK && out.fate == CAROM_FATE_CAPTURE;
    }
    if (captured) {
        const real more = (real)(mdot / area_of(f, t));
        ADD(real, &F_STORAGE_R(f, t, SV_DPMS_ACCRETION), more);
    }
#endif
}

DEFINE_DPM_SCALAR_UPDATE(carom_spin, c, t, initialize, p)
{
    (void)c;
    (void)t;
#if !RP_HOST
    if (initialize && ready && walls.spin >= 0) {
        int i;
        for (i = 0; i < 3; i++) {
            PARTICLE_USER_REAL(p, walls.spin + i) = 0;
        }
    }
#else
    (void)initialize;
    (void)p;
#endif
}

/* Over all nodes. */
DEFINE_ON_DEMAND(carom_report)
{
#if !RP_HOST
    size_t i;

    if (!ready) {
        Error("%s\n", trouble);
        return;
    }
    Message0("\n%8s %-24s %12s %12s %14s\n", "zone", "name", "rebounds", "captures",
             walls.deposit == CAROM_DEPOSIT_RATE ? "captured kg/s" : "captured kg");
    for (i = 0; i < walls.n; i++) {
        const carom_wall_zone *zone = &walls.zones[i];
        /* the sums are made by all nodes, whoever writes */
        const int rebounds = PRF_GISUM1(zone->rebounds), captures = PRF_GISUM1(zone->captures);
        const double captured = PRF_GRSUM1((real)zone->captured);
        Message0("%8d %-24s %12d %12d %14.6g\n", zone->id, zone->name, rebounds, captures, captured);
    }
#endif
}

/* Counters, and the walls' user memories, to zero: before the last update of a steady case, say. */
DEFINE_ON_DEMAND(carom_reset)
{
#if !RP_HOST
    Domain *domain = Get_Domain(1);
    Thread *t;
    cell_t c;
    size_t i;

    for (i = 0; ready && i < walls.n; i++) {
        walls.zones[i].rebounds = walls.zones[i].captures = 0;
        walls.zones[i].captured = 0.0;
    }
    if (ready && walls.deposit != CAROM_DEPOSIT_NONE && domain != NULL) {
        thread_loop_c(t, domain)
        {
            begin_c_loop(c, t)
            {
                C_UDMI(c, t, walls.memory) = C_UDMI(c, t, walls.memory + 1) = 0;
            }
            end_c_loop(c, t)
        }
    }
#endif
}
