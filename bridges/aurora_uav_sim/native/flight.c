// SPDX-FileCopyrightText: 2026 The AURORA authors
// SPDX-License-Identifier: Apache-2.0
//
// The physics steps of multirotor.py and control.py, compiled. The Python files are the truth: what
// is computed here has the same operations in the same order, so that every bit is the same (to be
// compiled without contraction of a * b + c). tools/aurora_setup compiles it and passes the names of
// the Python files as EQUAL_TO and their digest as SOURCES; native_code.py takes it only beside
// those very files. Attributes have the names that they have in Python, which creates and resets the objects.

#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <math.h>
#include <structmember.h>

static const double GRAVITY_MPS2 = 9.80665;
static const double LEVELLING = 0.8;

typedef struct {
    PyObject_HEAD
    double x, y, z, vx, vy, vz, qw, qx, qy, qz, p, q, r, f0, f1, f2, f3;
    double inverse_mass, jx, jy, jz, inverse_jx, inverse_jy, inverse_jz;
    double lag, offset, moment, drag1, drag2, friction;
    char on_ground;
} Body;

typedef struct {
    PyObject_HEAD
    double x, y, z, vx, vy, vz, ax, ay, az, cos_yaw, sin_yaw;
    double speed_limit, climb_limit, descent_limit;
    char follow_xy, follow_z;
} Point;

typedef struct {
    PyObject_HEAD
    PyObject *body;
    double integral_x, integral_y, integral_z;
    double mass, drag1, drag2, jx, jy, jz, max_n, min_n, roll_share, yaw_share;
    double position_gain_hz, velocity_gain_hz, velocity_integral_hz2, integral_limit_mps2;
    double attitude_gain_hz, yaw_gain_hz, rate_gain_hz, yaw_rate_gain_hz;
    double tilt_rate_limit_radps, yaw_rate_limit_radps, tan_tilt_limit;
    double horizontal_acceleration_limit_mps2, vertical_acceleration_limit_mps2;
    double braking_mps2, vertical_braking_mps2;
} Cascade;

// Multirotor.step ------------------------------------------------------------------------------

static void rest(Body *s, double h, double ax, double ay, double normal)
{
    double vx = s->vx + h * ax;
    double vy = s->vy + h * ay;
    double speed = sqrt(vx * vx + vy * vy);
    double grip = h * s->friction * normal;
    double keep = speed > grip ? 1.0 - grip / speed : 0.0;
    s->x += 0.5 * h * (s->vx + vx * keep);
    s->y += 0.5 * h * (s->vy + vy * keep);
    s->vx = vx * keep;
    s->vy = vy * keep;
    s->vz = 0.0;
    s->z = 0.0;
    double x = s->qx * LEVELLING, y = s->qy * LEVELLING, w = s->qw, z = s->qz;
    double scale = 1.0 / sqrt(w * w + x * x + y * y + z * z);
    s->qw = w * scale;
    s->qx = x * scale;
    s->qy = y * scale;
    s->qz = z * scale;
    s->p = s->q = s->r = 0.0;
}

static void step(Body *s, double h, const double *c, double wind_x, double wind_y, double wind_z)
{
    double gain = h / (s->lag + h);
    double f0 = s->f0 + (c[0] - s->f0) * gain;
    double f1 = s->f1 + (c[1] - s->f1) * gain;
    double f2 = s->f2 + (c[2] - s->f2) * gain;
    double f3 = s->f3 + (c[3] - s->f3) * gain;
    s->f0 = f0, s->f1 = f1, s->f2 = f2, s->f3 = f3;
    double thrust = f0 + f1 + f2 + f3;
    double torque_x = s->offset * (f1 + f2 - f0 - f3);
    double torque_y = s->offset * (f1 + f3 - f0 - f2);
    double torque_z = s->moment * (f2 + f3 - f0 - f1);

    double jx = s->jx, jy = s->jy, jz = s->jz;
    double ix = s->inverse_jx, iy = s->inverse_jy, iz = s->inverse_jz;
    double p = s->p, q = s->q, r = s->r;
    double half = 0.5 * h;
    double pm = p + half * ix * (torque_x - (jz - jy) * q * r);
    double qm = q + half * iy * (torque_y - (jx - jz) * r * p);
    double rm = r + half * iz * (torque_z - (jy - jx) * p * q);
    s->p = p + h * ix * (torque_x - (jz - jy) * qm * rm);
    s->q = q + h * iy * (torque_y - (jx - jz) * rm * pm);
    s->r = r + h * iz * (torque_z - (jy - jx) * pm * qm);

    double w = s->qw, x = s->qx, y = s->qy, z = s->qz;
    double a = half * pm, b = half * qm, d = half * rm;
    double k = 1.0 - 0.5 * (a * a + b * b + d * d);
    double nw = k * w - a * x - b * y - d * z;
    double nx = k * x + a * w + d * y - b * z;
    double ny = k * y + b * w + a * z - d * x;
    double nz = k * z + d * w + b * x - a * y;
    double scale = 1.0 / sqrt(nw * nw + nx * nx + ny * ny + nz * nz);
    s->qw = w = nw * scale;
    s->qx = x = nx * scale;
    s->qy = y = ny * scale;
    s->qz = z = nz * scale;

    double vx = s->vx, vy = s->vy, vz = s->vz;
    double ux = vx - wind_x, uy = vy - wind_y, uz = vz - wind_z;
    double drag = s->drag1 + s->drag2 * sqrt(ux * ux + uy * uy + uz * uz);
    double im = s->inverse_mass;
    double ax = im * (2.0 * (x * z + w * y) * thrust - drag * ux);
    double ay = im * (2.0 * (y * z - w * x) * thrust - drag * uy);
    double az = im * ((1.0 - 2.0 * (x * x + y * y)) * thrust - drag * uz) - GRAVITY_MPS2;
    if (s->on_ground) {
        if (az <= 0.0) {
            rest(s, h, ax, ay, -az);
            return;
        }
        s->on_ground = 0;
    }
    double nvx = vx + h * ax, nvy = vy + h * ay, nvz = vz + h * az;
    s->vx = nvx, s->vy = nvy, s->vz = nvz;
    s->x += half * (vx + nvx);
    s->y += half * (vy + nvy);
    double height = s->z + half * (vz + nvz);
    s->z = height;
    if (height <= 0.0 && nvz <= 0.0) {
        s->z = 0.0;
        s->vz = 0.0;
        s->on_ground = 1;
    }
}

static int number(PyObject *object, double *value)
{
    *value = PyFloat_AsDouble(object);
    return !(*value == -1.0 && PyErr_Occurred());
}

static PyObject *body_step(Body *self, PyObject *const *arguments, Py_ssize_t count)
{
    double h, motors[4], wind[3];
    if (count != 5 || !PyTuple_Check(arguments[1]) || PyTuple_GET_SIZE(arguments[1]) != 4) {
        PyErr_SetString(PyExc_TypeError, "expected h, four motors, wind_x, wind_y, wind_z");
        return NULL;
    }
    if (!number(arguments[0], &h))
        return NULL;
    for (int i = 0; i < 4; i++)
        if (!number(PyTuple_GET_ITEM(arguments[1], i), &motors[i]))
            return NULL;
    for (int i = 0; i < 3; i++)
        if (!number(arguments[2 + i], &wind[i]))
            return NULL;
    step(self, h, motors, wind[0], wind[1], wind[2]);
    Py_RETURN_NONE;
}

// Controller.update ----------------------------------------------------------------------------

static double braking_speed(double distance, double gain, double braking)
{
    double linear = braking / (gain * gain);
    if (distance <= linear)
        return gain * distance;
    return sqrt(2.0 * braking * (distance - 0.5 * linear));
}

static int within(double value, double limit) { return -limit <= value && value <= limit; }

static double clip(double value, double limit)
{
    if (limit < 0.0)
        return 0.0;
    return value > limit ? limit : value < -limit ? -limit : value;
}

static double bounded(double value, double low, double high)
{
    value = low > value ? low : value;
    return high < value ? high : value;
}

static void mix(const Cascade *s, double thrust, const double *torque, double *f)
{
    double low = s->min_n, high = s->max_n;
    double roll = s->roll_share * torque[0];
    double pitch = s->roll_share * torque[1];
    double both = roll + pitch, difference = roll - pitch;
    double reach = both >= 0.0 ? both : -both;
    if (difference > reach)
        reach = difference;
    else if (-difference > reach)
        reach = -difference;
    double base = 0.25 * thrust;
    if (base < low + reach)
        base = low + reach;
    if (base > high - reach)
        base = high - reach;
    double room = base - reach - low;
    if (high - reach - base < room)
        room = high - reach - base;
    double yaw = s->yaw_share * torque[2];
    if (!within(yaw, room))
        yaw = clip(yaw, room);
    f[0] = base - both - yaw;
    f[1] = base + both - yaw;
    f[2] = base + difference + yaw;
    f[3] = base - difference + yaw;
    if (room < 0.0)
        for (int i = 0; i < 4; i++)
            f[i] = bounded(f[i], low, high);
}

static void attitude(const Cascade *s, const Body *body, double fx, double fy, double fz,
                     double cos_yaw, double sin_yaw, double *motors)
{
    double w = body->qw, x = body->qx, y = body->qy, z = body->qz;
    double xx = 1.0 - 2.0 * (y * y + z * z), xy = 2.0 * (x * y + w * z);
    double xz = 2.0 * (x * z - w * y);
    double yx = 2.0 * (x * y - w * z), yy = 1.0 - 2.0 * (x * x + z * z);
    double yz = 2.0 * (y * z + w * x);
    double zx = 2.0 * (x * z + w * y), zy = 2.0 * (y * z - w * x);
    double zz = 1.0 - 2.0 * (x * x + y * y);
    double thrust = fx * zx + fy * zy + fz * zz;
    double inverse = 1.0 / sqrt(fx * fx + fy * fy + fz * fz + 1e-12);
    double rate_x = -s->attitude_gain_hz * (fx * yx + fy * yy + fz * yz) * inverse;
    double rate_y = s->attitude_gain_hz * (fx * xx + fy * xy + fz * xz) * inverse;
    double limit = s->tilt_rate_limit_radps;
    if (!within(rate_x, limit))
        rate_x = clip(rate_x, limit);
    if (!within(rate_y, limit))
        rate_y = clip(rate_y, limit);
    double flat = 1.0 / sqrt(xx * xx + xy * xy + 1e-12);
    double cross = (xx * sin_yaw - xy * cos_yaw) * flat;
    double dot = (xx * cos_yaw + xy * sin_yaw) * flat;
    double error = cross >= 0.0 ? 2.0 : -2.0;
    if (dot > -0.999)
        error = cross * sqrt(2.0 / (1.0 + dot));
    limit = s->yaw_rate_limit_radps;
    double rate_z = s->yaw_gain_hz * error * zz;
    if (!within(rate_z, limit))
        rate_z = clip(rate_z, limit);

    double p = body->p, q = body->q, r = body->r;
    double jx = s->jx, jy = s->jy, jz = s->jz;
    double torque[3] = {
        jx * s->rate_gain_hz * (rate_x - p) + (jz - jy) * q * r,
        jy * s->rate_gain_hz * (rate_y - q) + (jx - jz) * r * p,
        jz * s->yaw_rate_gain_hz * (rate_z - r) + (jy - jx) * p * q,
    };
    mix(s, thrust, torque, motors);
}

static void update(Cascade *s, const Body *body, double h, const Point *t, double *motors)
{
    double vx = t->vx, vy = t->vy, vz = t->vz;
    if (t->follow_xy) {
        double ex = t->x - body->x, ey = t->y - body->y;
        double distance = sqrt(ex * ex + ey * ey);
        if (distance > 0.0) {
            double k = braking_speed(distance, s->position_gain_hz, s->braking_mps2) / distance;
            vx += k * ex;
            vy += k * ey;
        }
    }
    if (t->follow_z) {
        double ez = t->z - body->z;
        if (ez >= 0.0)
            vz += braking_speed(ez, s->position_gain_hz, s->vertical_braking_mps2);
        else
            vz -= braking_speed(-ez, s->position_gain_hz, s->vertical_braking_mps2);
    }
    double speed = sqrt(vx * vx + vy * vy);
    if (speed > t->speed_limit) {
        double k = t->speed_limit / speed;
        vx *= k;
        vy *= k;
        speed = t->speed_limit;
    }
    if (vz > t->climb_limit)
        vz = t->climb_limit;
    else if (vz < -t->descent_limit)
        vz = -t->descent_limit;

    double evx = vx - body->vx, evy = vy - body->vy, evz = vz - body->vz;
    double gain = s->velocity_gain_hz;
    double ax = gain * evx + s->integral_x + t->ax;
    double ay = gain * evy + s->integral_y + t->ay;
    double az = gain * evz + s->integral_z + t->az;
    double limit = s->horizontal_acceleration_limit_mps2;
    double size = sqrt(ax * ax + ay * ay);
    int saturated = size > limit;
    if (saturated) {
        double k = limit / size;
        ax *= k;
        ay *= k;
    }
    limit = s->vertical_acceleration_limit_mps2;
    int saturated_z = !within(az, limit);
    if (saturated_z)
        az = az > 0.0 ? limit : -limit;
    double drag = s->drag1 + s->drag2 * sqrt(speed * speed + vz * vz);
    double fx = s->mass * ax + drag * vx;
    double fy = s->mass * ay + drag * vy;
    double fz = s->mass * (az + GRAVITY_MPS2) + drag * vz;
    double sideways = sqrt(fx * fx + fy * fy);
    limit = s->tan_tilt_limit * fz;
    if (sideways > limit) {
        saturated = 1;
        double k = limit / sideways;
        fx *= k;
        fy *= k;
    }

    double rate = h * s->velocity_integral_hz2;
    limit = s->integral_limit_mps2;
    if (!saturated || ax * evx + ay * evy < 0.0) {
        double total = s->integral_x + rate * evx;
        s->integral_x = within(total, limit) ? total : clip(total, limit);
        total = s->integral_y + rate * evy;
        s->integral_y = within(total, limit) ? total : clip(total, limit);
    }
    if (!saturated_z || az * evz < 0.0) {
        double total = s->integral_z + rate * evz;
        s->integral_z = within(total, limit) ? total : clip(total, limit);
    }
    attitude(s, body, fx, fy, fz, t->cos_yaw, t->sin_yaw, motors);
}

static PyTypeObject BodyType, PointType;

static PyObject *cascade_update(Cascade *self, PyObject *const *arguments, Py_ssize_t count)
{
    double h, motors[4];
    if (count != 2 || !PyObject_TypeCheck(arguments[1], &PointType) || self->body == NULL ||
        !PyObject_TypeCheck(self->body, &BodyType)) {
        PyErr_SetString(PyExc_TypeError, "expected h and a compiled set-point and body");
        return NULL;
    }
    if (!number(arguments[0], &h))
        return NULL;
    update(self, (Body *)self->body, h, (Point *)arguments[1], motors);
    PyObject *found = PyTuple_New(4);
    for (int i = 0; found != NULL && i < 4; i++) {
        PyObject *value = PyFloat_FromDouble(motors[i]);
        if (value == NULL)
            Py_CLEAR(found);
        else
            PyTuple_SET_ITEM(found, i, value);
    }
    return found;
}

static void cascade_dealloc(Cascade *self)
{
    Py_CLEAR(self->body);
    Py_TYPE(self)->tp_free((PyObject *)self);
}

// fly ------------------------------------------------------------------------------------------

static PyTypeObject CascadeType;

static PyObject *flight_fly(PyObject *module, PyObject *const *arguments, Py_ssize_t count)
{
    double wind[3], h, motors[4];
    if (count != 6 || !PyObject_TypeCheck(arguments[0], &CascadeType) ||
        !PyObject_TypeCheck(arguments[1], &BodyType) ||
        !PyObject_TypeCheck(arguments[2], &PointType) || !PyTuple_Check(arguments[3]) ||
        PyTuple_GET_SIZE(arguments[3]) != 3 ||
        ((Cascade *)arguments[0])->body != arguments[1]) {
        PyErr_SetString(PyExc_TypeError,
                        "expected a compiled controller, its body, set-point, wind, h and steps");
        return NULL;
    }
    for (int i = 0; i < 3; i++)
        if (!number(PyTuple_GET_ITEM(arguments[3], i), &wind[i]))
            return NULL;
    if (!number(arguments[4], &h))
        return NULL;
    long steps = PyLong_AsLong(arguments[5]), flown = 0;
    if (steps == -1 && PyErr_Occurred())
        return NULL;
    Body *body = (Body *)arguments[1];
    while (flown < steps) {
        update((Cascade *)arguments[0], body, h, (Point *)arguments[2], motors);
        step(body, h, motors, wind[0], wind[1], wind[2]);
        flown++;
        if (body->on_ground)
            break;
    }
    return PyLong_FromLong(flown);
}

// Types ----------------------------------------------------------------------------------------

#define NUMBER(type, name) {#name, T_DOUBLE, offsetof(type, name), 0, NULL}
#define HIDDEN(type, name) {"_" #name, T_DOUBLE, offsetof(type, name), 0, NULL}
#define FLAG(type, name) {#name, T_BOOL, offsetof(type, name), 0, NULL}

static PyMemberDef body_members[] = {
    NUMBER(Body, x), NUMBER(Body, y), NUMBER(Body, z),
    NUMBER(Body, vx), NUMBER(Body, vy), NUMBER(Body, vz),
    NUMBER(Body, qw), NUMBER(Body, qx), NUMBER(Body, qy), NUMBER(Body, qz),
    NUMBER(Body, p), NUMBER(Body, q), NUMBER(Body, r),
    NUMBER(Body, f0), NUMBER(Body, f1), NUMBER(Body, f2), NUMBER(Body, f3),
    HIDDEN(Body, inverse_mass), HIDDEN(Body, jx), HIDDEN(Body, jy), HIDDEN(Body, jz),
    HIDDEN(Body, inverse_jx), HIDDEN(Body, inverse_jy), HIDDEN(Body, inverse_jz),
    HIDDEN(Body, lag), HIDDEN(Body, offset), HIDDEN(Body, moment),
    HIDDEN(Body, drag1), HIDDEN(Body, drag2), HIDDEN(Body, friction),
    FLAG(Body, on_ground), {NULL},
};

static PyMemberDef point_members[] = {
    NUMBER(Point, x), NUMBER(Point, y), NUMBER(Point, z),
    NUMBER(Point, vx), NUMBER(Point, vy), NUMBER(Point, vz),
    NUMBER(Point, ax), NUMBER(Point, ay), NUMBER(Point, az),
    NUMBER(Point, cos_yaw), NUMBER(Point, sin_yaw), NUMBER(Point, speed_limit),
    NUMBER(Point, climb_limit), NUMBER(Point, descent_limit),
    FLAG(Point, follow_xy), FLAG(Point, follow_z), {NULL},
};

static PyMemberDef cascade_members[] = {
    {"_body", T_OBJECT, offsetof(Cascade, body), 0, NULL},
    HIDDEN(Cascade, integral_x), HIDDEN(Cascade, integral_y), HIDDEN(Cascade, integral_z),
    HIDDEN(Cascade, mass), HIDDEN(Cascade, drag1), HIDDEN(Cascade, drag2),
    HIDDEN(Cascade, jx), HIDDEN(Cascade, jy), HIDDEN(Cascade, jz),
    HIDDEN(Cascade, max_n), HIDDEN(Cascade, min_n),
    HIDDEN(Cascade, roll_share), HIDDEN(Cascade, yaw_share),
    NUMBER(Cascade, position_gain_hz), NUMBER(Cascade, velocity_gain_hz),
    NUMBER(Cascade, velocity_integral_hz2), NUMBER(Cascade, integral_limit_mps2),
    NUMBER(Cascade, attitude_gain_hz), NUMBER(Cascade, yaw_gain_hz),
    NUMBER(Cascade, rate_gain_hz), NUMBER(Cascade, yaw_rate_gain_hz),
    NUMBER(Cascade, tilt_rate_limit_radps), NUMBER(Cascade, yaw_rate_limit_radps),
    NUMBER(Cascade, tan_tilt_limit),
    NUMBER(Cascade, horizontal_acceleration_limit_mps2),
    NUMBER(Cascade, vertical_acceleration_limit_mps2),
    NUMBER(Cascade, braking_mps2), NUMBER(Cascade, vertical_braking_mps2), {NULL},
};

static PyMethodDef body_methods[] = {
    {"step", (PyCFunction)(void (*)(void))body_step, METH_FASTCALL, NULL}, {NULL},
};

static PyMethodDef cascade_methods[] = {
    {"update", (PyCFunction)(void (*)(void))cascade_update, METH_FASTCALL, NULL}, {NULL},
};

#define TYPE(type, text, its_members, its_methods)                                                 \
    {                                                                                              \
        PyVarObject_HEAD_INIT(NULL, 0).tp_name = "aurora_uav_flight." text,                        \
        .tp_basicsize = sizeof(type), .tp_flags = Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE,        \
        .tp_members = its_members, .tp_methods = its_methods, .tp_new = PyType_GenericNew,         \
    }

static PyTypeObject BodyType = TYPE(Body, "Body", body_members, body_methods);
static PyTypeObject PointType = TYPE(Point, "Point", point_members, NULL);
static PyTypeObject CascadeType = TYPE(Cascade, "Cascade", cascade_members, cascade_methods);

static PyMethodDef methods[] = {
    {"fly", (PyCFunction)(void (*)(void))flight_fly, METH_FASTCALL, NULL}, {NULL},
};

static struct PyModuleDef module = {
    PyModuleDef_HEAD_INIT, "aurora_uav_flight", "multirotor.py and control.py, compiled.", -1,
    methods, NULL, NULL, NULL, NULL,
};

PyMODINIT_FUNC PyInit_aurora_uav_flight(void)
{
    CascadeType.tp_dealloc = (destructor)cascade_dealloc;
    if (PyType_Ready(&BodyType) < 0 || PyType_Ready(&PointType) < 0 ||
        PyType_Ready(&CascadeType) < 0)
        return NULL;
    PyObject *made = PyModule_Create(&module);
    if (made == NULL || PyModule_AddStringConstant(made, "EQUAL_TO", EQUAL_TO) < 0 ||
        PyModule_AddStringConstant(made, "SOURCES", SOURCES) < 0 ||
        PyModule_AddObjectRef(made, "Body", (PyObject *)&BodyType) < 0 ||
        PyModule_AddObjectRef(made, "Point", (PyObject *)&PointType) < 0 ||
        PyModule_AddObjectRef(made, "Cascade", (PyObject *)&CascadeType) < 0) {
        Py_XDECREF(made);
        return NULL;
    }
    return made;
}
