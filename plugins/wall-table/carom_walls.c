/* The table of zones. One entry a line, words separated by blanks, `#` begins a comment:
 *
 *     materials mine.toml                      more materials for the laws below (optional)
 *     zone 5 floor walls.toml:glass            Fluent: zone id, a name for messages, FILE:NAME of the law
 *     zone floor walls.toml:glass              code_saturne: name of the zone, law
 *     zone 7 belt walls.toml:glass velocity 1 0 0
 *     zone 9 filter trap                       or escape
 *     spin 0                                   keep the spin in user scalars (variables) 0, 1 and 2
 *     deposit mass 0                           Fluent: add up what sticks in user memory 0, impacts in 1 (or: deposit rate 0)
 *     record impacts                           code_saturne: write every impact to impacts.csv
 *
 * Files are looked for beside the table. */
#include "carom_walls.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST_WORDS 9

typedef struct {
    carom_walls *walls;
    int line;
    char materials[1024];
    char *message;
    size_t room;
} reader;

static int refuse(reader *r, const char *format, ...)
{
    va_list arguments;
    int used = r->line > 0 ? snprintf(r->message, r->room, "%s:%d: ", r->walls->file, r->line)
                           : snprintf(r->message, r->room, "%s: ", r->walls->file);

    if (used < 0 || (size_t)used >= r->room) {
        return -1;
    }
    va_start(arguments, format);
    vsnprintf(r->message + used, r->room - (size_t)used, format, arguments);
    va_end(arguments);
    return -1;
}

/* What stands after the folder in a path, as Unix or Windows writes it: /cases/walls.toml, C:\cases\walls.toml */
static const char *after_folder(const char *path)
{
    const char *after = path[0] != '\0' && path[1] == ':' ? path + 2 : path, *c;

    for (c = after; *c != '\0'; c++) {
        if (*c == '/' || *c == '\\') {
            after = c + 1;
        }
    }
    return after;
}

static int is_absolute(const char *path)
{
    return path[0] == '/' || path[0] == '\\' || (isalpha((unsigned char)path[0]) && path[1] == ':');
}

/* A file named in the table, from where the table is. */
static int beside(reader *r, const char *file, char *path, size_t room)
{
    const int folder = is_absolute(file) ? 0 : (int)(after_folder(r->walls->file) - r->walls->file);
    const int used = snprintf(path, room, "%.*s%s", folder, r->walls->file, file);

    return used < 0 || (size_t)used >= room ? refuse(r, "the path of '%s' is too long", file) : 0;
}

static int number(reader *r, const char *word, const char *what, double *value)
{
    char *end;

    *value = strtod(word, &end);
    if (end == word || *end != '\0' || !isfinite(*value)) {
        return refuse(r, "'%s' is no number; %s is wanted", word, what);
    }
    return 0;
}

static int whole(reader *r, const char *word, const char *what, int *value)
{
    char *end;
    const long read = strtol(word, &end, 10);

    if (end == word || *end != '\0' || read < 0 || read > 1000000000L) {
        return refuse(r, "'%s' is no %s; a whole number, 0 or more, is wanted", word, what);
    }
    *value = (int)read;
    return 0;
}

/* FILE:NAME, compiled. */
static int law(reader *r, carom_wall_zone *zone, const char *word)
{
    char file[1024], path[2100];
    const char *colon = strrchr(word, ':');

    /* the colon of a drive is no law's: C:\cases\walls.toml */
    if (colon == NULL || colon == word || colon[1] == '\0' || after_folder(colon + 1) != colon + 1
        || (size_t)(colon - word) >= sizeof file) {
        return refuse(r, "zone %s: '%s' is no law; FILE:NAME, trap or escape is wanted, such as walls.toml:glass",
                      zone->name, word);
    }
    memcpy(file, word, (size_t)(colon - word));
    file[colon - word] = '\0';
    if (beside(r, file, path, sizeof path) != 0) {
        return -1;
    }
    if (carom_law_from_file(path, colon + 1, r->materials[0] != '\0' ? r->materials : NULL, &zone->law)
        != CAROM_STATUS_OK) {
        return refuse(r, "zone %s: %s", zone->name, carom_last_error());
    }
    return 0;
}

/* The words of a zone from its name on: name, law and perhaps a velocity. */
static int named_zone(reader *r, carom_wall_zone *zone, char **words, int n)
{
    int i;

    if (strlen(words[0]) >= sizeof zone->name) {
        return refuse(r, "the name '%s' is too long", words[0]);
    }
    strcpy(zone->name, words[0]);
    for (i = 0; n == 6 && i < 3; i++) {
        if (number(r, words[3 + i], "a velocity in m/s", &zone->velocity[i]) != 0) {
            return -1;
        }
    }
    if (strcmp(words[1], "trap") == 0) {
        zone->kind = CAROM_WALL_TRAP;
    } else if (strcmp(words[1], "escape") == 0) {
        zone->kind = CAROM_WALL_ESCAPE;
    } else {
        return law(r, zone, words[1]);
    }
    return 0;
}

static int known_before(reader *r, const carom_wall_zone *zone)
{
    const carom_walls *walls = r->walls;
    const int by_id = walls->key == CAROM_ZONES_BY_ID;
    size_t i;

    for (i = 0; i < walls->n; i++) {
        const carom_wall_zone *there = &walls->zones[i];
        if (by_id ? there->id == zone->id : strcmp(there->name, zone->name) == 0) {
            return by_id ? refuse(r, "zone %d (%s) was given before, in line %d as %s", zone->id, zone->name, there->line,
                                  there->name)
                         : refuse(r, "zone %s was given before, in line %d", zone->name, there->line);
        }
    }
    return 0;
}

static int add_zone(reader *r, char **words, int n)
{
    carom_walls *walls = r->walls;
    const int by_id = walls->key == CAROM_ZONES_BY_ID, first = by_id ? 2 : 1;
    carom_wall_zone zone = {0}, *grown;

    zone.id = -1;
    zone.line = r->line;
    if (n != first + 2 && !(n == first + 6 && strcmp(words[first + 2], "velocity") == 0)) {
        return by_id ? refuse(r, "a zone has an id, a name and a law: zone 5 floor walls.toml:glass [velocity X Y Z]")
                     : refuse(r, "a zone has a name and a law: zone floor walls.toml:glass [velocity X Y Z]");
    }
    if (by_id && whole(r, words[1], "zone id", &zone.id) != 0) {
        return -1;
    }
    if (named_zone(r, &zone, words + first, n - first) != 0 || known_before(r, &zone) != 0) {
        carom_law_free(zone.law);
        return -1;
    }
    grown = realloc(walls->zones, (walls->n + 1) * sizeof *grown);
    if (grown == NULL) {
        carom_law_free(zone.law);
        return refuse(r, "no memory left");
    }
    grown[walls->n++] = zone;
    walls->zones = grown;
    return 0;
}

static int entry(reader *r, char **words, int n)
{
    carom_walls *walls = r->walls;
    const int by_id = walls->key == CAROM_ZONES_BY_ID;

    if (strcmp(words[0], "zone") == 0) {
        return add_zone(r, words, n);
    }
    if (strcmp(words[0], "materials") == 0) {
        return n == 2 ? beside(r, words[1], r->materials, sizeof r->materials) : refuse(r, "one file is wanted after materials");
    }
    if (strcmp(words[0], "spin") == 0) {
        return n == 2 ? whole(r, words[1], "user scalar", &walls->spin)
                      : refuse(r, "the first of three user scalars is wanted after spin: spin 0");
    }
    if (strcmp(words[0], "record") == 0 && !by_id) {
        return n == 2 && strlen(words[1]) < sizeof walls->record
                   ? (strcpy(walls->record, words[1]), 0)
                   : refuse(r, "the beginning of a file's name is wanted after record: record impacts");
    }
    if (strcmp(words[0], "deposit") == 0 && by_id) {
        if (n != 3 || (strcmp(words[1], "mass") != 0 && strcmp(words[1], "rate") != 0)) {
            return refuse(r, "mass or rate and the first of two user memories are wanted: deposit mass 0");
        }
        walls->deposit = words[1][0] == 'm' ? CAROM_DEPOSIT_MASS : CAROM_DEPOSIT_RATE;
        return whole(r, words[2], "user memory", &walls->memory);
    }
    return refuse(r, "unknown entry '%s'; known are zone, materials, spin and %s", words[0], by_id ? "deposit" : "record");
}

static int read_lines(reader *r, FILE *file)
{
    char line[4096], *words[MOST_WORDS + 1], *word;
    int n;

    while (fgets(line, sizeof line, file) != NULL) {
        r->line++;
        if (strchr(line, '\n') == NULL && !feof(file)) {
            return refuse(r, "the line is too long");
        }
        line[strcspn(line, "#")] = '\0';
        n = 0;
        for (word = strtok(line, " \t\r\n"); word != NULL && n <= MOST_WORDS; word = strtok(NULL, " \t\r\n")) {
            words[n++] = word;
        }
        if (n > 0 && entry(r, words, n) != 0) {
            return -1;
        }
    }
    r->line = 0;
    return r->walls->n > 0 ? 0 : refuse(r, "no zone is given");
}

int carom_walls_read(carom_walls *walls, const char *path, carom_zone_key key, char *message, size_t room)
{
    reader r = {0};
    FILE *file;
    int status;

    memset(walls, 0, sizeof *walls);
    walls->spin = -1;
    walls->key = key;
    r.walls = walls;
    r.message = message;
    r.room = room;
    snprintf(walls->file, sizeof walls->file, "%s", path);
    file = fopen(path, "r");
    if (file == NULL) {
        return refuse(&r, "the table of zones cannot be opened; set CAROM_WALLS or start in its folder");
    }
    status = read_lines(&r, file);
    fclose(file);
    if (status != 0) {
        carom_walls_free(walls);
    }
    return status;
}

void carom_walls_free(carom_walls *walls)
{
    size_t i;

    for (i = 0; i < walls->n; i++) {
        carom_law_free(walls->zones[i].law);
    }
    free(walls->zones);
    walls->zones = NULL;
    walls->n = 0;
}

carom_wall_zone *carom_walls_find(const carom_walls *walls, int id)
{
    size_t i;

    for (i = 0; i < walls->n; i++) {
        if (walls->zones[i].id == id) {
            return &walls->zones[i];
        }
    }
    return NULL;
}

void carom_walls_draw(uint64_t seed, const double *numbers, int n, double draws[4])
{
    uint64_t state = seed, bits, z;
    int i;

    for (i = 0; i < n; i++) {
        memcpy(&bits, &numbers[i], sizeof bits);
        state = (state ^ bits) * UINT64_C(0x9E3779B97F4A7C15);
        state ^= state >> 32;
    }
    for (i = 0; i < 4; i++) {
        /* SplitMix64 (Steele, Lea & Flood 2014, doi:10.1145/2660193.2660195) */
        z = state += UINT64_C(0x9E3779B97F4A7C15);
        z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
        z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
        draws[i] = (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
}
