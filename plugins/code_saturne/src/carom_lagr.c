/* carom in code_saturne 6.0: cs_lagr_user_boundary_interaction over the C interface. See carom_lagr.h and README.md. */
#include "carom_lagr.h"

#include "carom_walls.h"

#include "cs_defs.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bft_error.h"
#include "bft_mem.h"
#include "cs_boundary_zone.h"
#include "cs_field.h"
#include "cs_lagr.h"
#include "cs_lagr_event.h"
#include "cs_lagr_particle.h"
#include "cs_lagr_prototypes.h"
#include "cs_lagr_tracking.h"
#include "cs_log.h"
#include "cs_math.h"
#include "cs_mesh_location.h"
#include "cs_mesh_quantities.h"
#include "cs_parall.h"
#include "cs_post.h"
#include "cs_time_step.h"

static carom_walls walls;
static carom_wall_zone **by_zone; /* by the boundary zone's id; NULL where the table says nothing */
static cs_field_t *deposit, *impacts;
static FILE *record;
static char record_file[300];

static void stop(const char *message)
{
    bft_error(__FILE__, __LINE__, 0, "carom: %s", message);
}

static cs_field_t *face_field(const char *name, const char *label)
{
    cs_field_t *field = cs_field_create(name, CS_FIELD_PROPERTY, CS_MESH_LOCATION_BOUNDARY_FACES, 1, false);

    cs_field_set_key_int(field, cs_field_key_id("post_vis"), CS_POST_ON_LOCATION);
    cs_field_set_key_str(field, cs_field_key_id("label"), label);
    return field;
}

void carom_lagr_setup(void)
{
    const char *path = getenv("CAROM_WALLS");
    char message[4096];

    if (carom_walls_read(&walls, path != NULL && path[0] != '\0' ? path : "carom-walls.txt", CAROM_ZONES_BY_NAME, message,
                         sizeof message) != 0) {
        stop(message);
    }
    if (walls.spin >= 0 && cs_glob_lagr_model->n_user_variables < walls.spin + 3) {
        cs_glob_lagr_model->n_user_variables = walls.spin + 3;
    }
    deposit = face_field("carom_deposit", "Deposit [kg/m2]");
    impacts = face_field("carom_impacts", "Impacts");
}

/* Where a particle's spin is kept; NULL where it is not. */
static cs_real_t *spin_of(cs_lagr_particle_set_t *particles, cs_lnum_t p_id)
{
    return walls.spin < 0 ? NULL : (cs_real_t *)cs_lagr_particles_attr(particles, p_id, CS_LAGR_USER) + walls.spin;
}

/* code_saturne 6.0 sets the first user variable of new particles to zero, not the others. */
void carom_lagr_new_particles(cs_lagr_particle_set_t *particles, const cs_lnum_t particle_range[2])
{
    for (cs_lnum_t p_id = particle_range[0]; walls.spin >= 0 && p_id < particle_range[1]; p_id++) {
        memset(spin_of(particles, p_id), 0, 3 * sizeof(cs_real_t));
    }
}

/* The zones' names, for a message. */
static void list_zones(char *text, size_t room)
{
    size_t used = 0;
    int i;

    text[0] = '\0';
    for (i = 0; i < cs_boundary_zone_n_zones() && used < room; i++) {
        used += (size_t)snprintf(text + used, room - used, "%s%s", i > 0 ? ", " : "", cs_boundary_zone_by_id(i)->name);
    }
}

static void match_zones(void)
{
    const int n = cs_boundary_zone_n_zones();
    char known[1024], message[2400];
    size_t i;

    BFT_MALLOC(by_zone, n, carom_wall_zone *);
    memset(by_zone, 0, (size_t)n * sizeof *by_zone);
    for (i = 0; i < walls.n; i++) {
        const cs_zone_t *zone = cs_boundary_zone_by_name_try(walls.zones[i].name);
        if (zone == NULL) {
            list_zones(known, sizeof known);
            snprintf(message, sizeof message, "%s:%d: zone %s is no boundary zone of this case; known are %s", walls.file,
                     walls.zones[i].line, walls.zones[i].name, known);
            stop(message);
        }
        walls.zones[i].id = zone->id;
        by_zone[zone->id] = &walls.zones[i];
    }
}

/* A record with a hole in it is no record: a disk that is full ends the run. */
static void record_fails(void)
{
    char message[600];

    snprintf(message, sizeof message, "the record of impacts %s cannot be written: %s", record_file, strerror(errno));
    stop(message);
}

static void open_record(void)
{
    if (cs_glob_n_ranks > 1) {
        snprintf(record_file, sizeof record_file, "%s-%d.csv", walls.record, cs_glob_rank_id);
    } else {
        snprintf(record_file, sizeof record_file, "%s.csv", walls.record);
    }
    record = fopen(record_file, "w");
    if (record == NULL) {
        record_fails();
        return;
    }
    fprintf(record, "zone,fate,time,mass,x,y,z,diameter,density,vx_in,vy_in,vz_in,wx_in,wy_in,wz_in,nx,ny,nz,ux,uy,uz,"
                    "vx,vy,vz,wx,wy,wz,draw0,draw1,draw2,draw3\n");
}

void carom_lagr_boundaries(void)
{
    static const cs_lagr_bc_type_t types[] = {CS_LAGR_BC_USER, CS_LAGR_DEPO1, CS_LAGR_OUTLET};
    cs_lagr_zone_data_t *conditions = cs_lagr_get_boundary_conditions();
    size_t i;

    if (by_zone == NULL) {
        match_zones();
        if (walls.record[0] != '\0') {
            open_record();
        }
    }
    for (i = 0; i < walls.n; i++) {
        conditions->zone_type[walls.zones[i].id] = types[walls.zones[i].kind];
    }
}

/* What carom is told of the impact. The normal leads back to the side that the path came from, whichever way the face has it. */
static carom_impact_in impact_of(cs_lagr_particle_set_t *particles, cs_lnum_t p_id, const carom_wall_zone *zone,
                                 const cs_real_t face_norm[3], const cs_real_t path[3], const cs_real_t at[3])
{
    const cs_real_t *velocity = cs_lagr_particles_attr_const(particles, p_id, CS_LAGR_VELOCITY);
    const cs_real_t *spin = spin_of(particles, p_id);
    const double sign = cs_math_3_dot_product(path, face_norm) > 0.0 ? -1.0 : 1.0;
    double numbers[8];
    carom_impact_in in = {0};

    in.size = sizeof in;
    in.diameter = cs_lagr_particles_get_real(particles, p_id, CS_LAGR_DIAMETER);
    in.density = cs_lagr_particles_get_real(particles, p_id, CS_LAGR_MASS)
                 / (cs_math_pi / 6.0 * in.diameter * in.diameter * in.diameter);
    for (int k = 0; k < 3; k++) {
        in.velocity[k] = velocity[k];
        in.normal[k] = sign * face_norm[k];
        in.wall_velocity[k] = zone->velocity[k];
        in.spin[k] = spin != NULL ? spin[k] : 0.0;
        numbers[k] = velocity[k];
        numbers[3 + k] = at[k];
    }
    numbers[6] = cs_glob_time_step->t_cur;
    /* what code_saturne 6.0 gives each particle for life; two that hit the same place at the same time draw differently */
    numbers[7] = particles->p_am->size[CS_LAGR_RANDOM_VALUE] > 0
                     ? cs_lagr_particles_get_real(particles, p_id, CS_LAGR_RANDOM_VALUE)
                     : 0.0;
    carom_walls_draw(0, numbers, 8, in.draws);
    return in;
}

/* The particle goes on from the wall, along the rest of its path. */
static void go_on(cs_lagr_particle_set_t *particles, cs_lnum_t p_id, const cs_real_t path[3], const double normal[3],
                  const cs_real_t at[3])
{
    cs_real_t *coords = cs_lagr_particles_attr(particles, p_id, CS_LAGR_COORDS);
    cs_real_t *seen = cs_lagr_particles_attr(particles, p_id, CS_LAGR_VELOCITY_SEEN);
    /* The tracking keeps the beginning of the path ahead of each particle's own values (cs_lagr_tracking.c of 6.0) and offers no
       function for it; its own rebounds set it just so, a hundredth of the way from the wall to the cell's centre. */
    cs_real_t *start = (cs_real_t *)(particles->p_buffer + particles->p_am->extents * (size_t)p_id);
    const cs_lnum_t cell = cs_lagr_particles_get_lnum(particles, p_id, CS_LAGR_CELL_ID);
    const cs_real_t *centre = cs_glob_mesh_quantities->cell_cen + 3 * cell;
    const cs_real_t mirrored = 2.0 * cs_math_3_dot_product(seen, normal);

    for (int k = 0; k < 3; k++) {
        seen[k] -= mirrored * normal[k];
        start[k] = at[k] + 1e-2 * (centre[k] - at[k]);
        /* a hair off the wall, so that a path that is all but used up ends inside the cell */
        coords[k] = at[k] + path[k] + 1e-9 * (centre[k] - at[k]);
    }
}

/* The velocity changes, and with it the rest of the path, for the time that this would have taken. */
static void rebound(cs_lagr_particle_set_t *particles, cs_lnum_t p_id, const carom_impact_in *in,
                    const carom_impact_out *out, const cs_real_t path[3], const cs_real_t at[3])
{
    cs_real_t *velocity = cs_lagr_particles_attr(particles, p_id, CS_LAGR_VELOCITY);
    cs_real_t *spin = spin_of(particles, p_id);
    const cs_real_t speed = cs_math_3_dot_product(in->velocity, in->normal), step = cs_glob_lagr_time_step->dtp;
    const cs_real_t rest = speed < 0.0 ? cs_math_3_dot_product(path, in->normal) / speed : 0.0;
    const cs_real_t time = rest < step ? rest : step;
    cs_real_t turned[3];

    for (int k = 0; k < 3; k++) {
        turned[k] = path[k] + time * (out->velocity[k] - in->velocity[k]);
        velocity[k] = out->velocity[k];
        if (spin != NULL) {
            spin[k] = out->spin[k];
        }
    }
    /* it must not end behind the wall: a wall that moves, a step cut short */
    const cs_real_t along = cs_math_3_dot_product(turned, in->normal);
    for (int k = 0; along < 0.0 && k < 3; k++) {
        turned[k] -= along * in->normal[k];
    }
    go_on(particles, p_id, turned, in->normal, at);
}

/* The path leads into the wall, the velocity away from it, as may happen at the end of a step: the path is mirrored. */
static void turn_path(cs_lagr_particle_set_t *particles, cs_lnum_t p_id, const carom_impact_in *in, const cs_real_t path[3],
                      const cs_real_t at[3])
{
    const cs_real_t along = cs_math_3_dot_product(path, in->normal);
    cs_real_t turned[3];

    for (int k = 0; k < 3; k++) {
        turned[k] = path[k] - 2.0 * along * in->normal[k];
    }
    go_on(particles, p_id, turned, in->normal, at);
}

static void capture(cs_lagr_particle_set_t *particles, cs_lnum_t p_id, const carom_impact_out *out, const cs_real_t at[3])
{
    cs_real_t *coords = cs_lagr_particles_attr(particles, p_id, CS_LAGR_COORDS);
    cs_real_t *velocity = cs_lagr_particles_attr(particles, p_id, CS_LAGR_VELOCITY);

    particles->n_part_dep += 1;
    particles->weight_dep += cs_lagr_particles_get_real(particles, p_id, CS_LAGR_STAT_WEIGHT);
    cs_lagr_particles_set_flag(particles, p_id, CS_LAGR_PART_DEPOSITED);
    for (int k = 0; k < 3; k++) {
        coords[k] = at[k];
        velocity[k] = out->velocity[k];
    }
}

/* What came of it, from the particle itself. */
static void write_down(cs_lagr_particle_set_t *particles, cs_lnum_t p_id, const carom_wall_zone *zone,
                       const carom_impact_in *in, const carom_impact_out *out, const cs_real_t at[3], double mass)
{
    const cs_real_t *velocity = cs_lagr_particles_attr_const(particles, p_id, CS_LAGR_VELOCITY);
    const double *vectors[] = {in->velocity, in->spin, in->normal, in->wall_velocity, velocity, out->spin};

    fprintf(record, "%s,%s,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", zone->name, carom_fate_name(out->fate),
            cs_glob_time_step->t_cur, mass, at[0], at[1], at[2], in->diameter, in->density);
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++) {
        fprintf(record, ",%.17g,%.17g,%.17g", vectors[i][0], vectors[i][1], vectors[i][2]);
    }
    fprintf(record, ",%.17g,%.17g,%.17g,%.17g\n", in->draws[0], in->draws[1], in->draws[2], in->draws[3]);
    if (ferror(record)) {
        record_fails();
    }
}

void cs_lagr_user_boundary_interaction(cs_lagr_particle_set_t *particles, cs_lnum_t p_id, cs_lnum_t face_id,
                                       const cs_real_t face_norm[3], const cs_real_t c_intersect[3], cs_real_t t_intersect,
                                       int b_zone_id, int *event_flag, cs_lagr_tracking_state_t *tracking_state)
{
    carom_wall_zone *zone = by_zone != NULL ? by_zone[b_zone_id] : NULL;
    const cs_real_t *coords = cs_lagr_particles_attr_const(particles, p_id, CS_LAGR_COORDS);
    const cs_real_t path[3] = {coords[0] - c_intersect[0], coords[1] - c_intersect[1], coords[2] - c_intersect[2]};
    const double mass = cs_lagr_particles_get_real(particles, p_id, CS_LAGR_STAT_WEIGHT)
                        * cs_lagr_particles_get_real(particles, p_id, CS_LAGR_MASS);
    carom_impact_in in;
    carom_impact_out out;
    carom_status status;
    char message[4300];

    CS_UNUSED(t_intersect);
    if (zone == NULL) {
        snprintf(message, sizeof message, "zone %s has the type CS_LAGR_BC_USER but no entry in %s",
                 cs_boundary_zone_by_id(b_zone_id)->name, walls.file);
        stop(message);
        return;
    }
    in = impact_of(particles, p_id, zone, face_norm, path, c_intersect);
    out.size = sizeof out;
    status = carom_impact(zone->law, &in, &out);
    if (status == CAROM_STATUS_NOT_APPROACHING) {
        turn_path(particles, p_id, &in, path, c_intersect);
        *tracking_state = CS_LAGR_PART_TO_SYNC;
        return;
    }
    if (status != CAROM_STATUS_OK) {
        snprintf(message, sizeof message, "zone %s: %s", zone->name, carom_last_error());
        stop(message);
        return;
    }
    impacts->val[face_id] += 1.0;
    if (out.fate == CAROM_FATE_CAPTURE) {
        capture(particles, p_id, &out, c_intersect);
        deposit->val[face_id] += mass / cs_glob_mesh_quantities->b_face_surf[face_id];
        zone->captures++;
        zone->captured += mass;
        *event_flag |= CS_EVENT_OUTFLOW | CS_EVENT_DEPOSITION;
        *tracking_state = CS_LAGR_PART_OUT;
    } else {
        rebound(particles, p_id, &in, &out, path, c_intersect);
        zone->rebounds++;
        *event_flag |= CS_EVENT_REBOUND;
        *tracking_state = CS_LAGR_PART_TO_SYNC;
    }
    if (record != NULL) {
        write_down(particles, p_id, zone, &in, &out, c_intersect, mass);
    }
}

void carom_lagr_report(void)
{
    size_t i;

    cs_log_printf(CS_LOG_DEFAULT, "\ncarom %s: impacts by zone\n  %-24s %12s %12s %14s\n", carom_version(), "zone", "rebounds",
                  "captures", "captured [kg]");
    for (i = 0; i < walls.n; i++) {
        cs_gnum_t counts[2] = {(cs_gnum_t)walls.zones[i].rebounds, (cs_gnum_t)walls.zones[i].captures};
        double captured = walls.zones[i].captured;
        cs_parall_counter(counts, 2);
        cs_parall_sum(1, CS_DOUBLE, &captured);
        cs_log_printf(CS_LOG_DEFAULT, "  %-24s %12llu %12llu %14.6g\n", walls.zones[i].name, (unsigned long long)counts[0],
                      (unsigned long long)counts[1], captured);
    }
    if (record != NULL) {
        /* what the buffer still holds is written here */
        if (fclose(record) != 0) {
            record_fails();
        }
        record = NULL;
    }
    carom_walls_free(&walls);
    BFT_FREE(by_zone);
}
