// SPDX-FileCopyrightText: 2026 The AURORA authors
// SPDX-License-Identifier: Apache-2.0
//
// `pack`, `split`, the layouts and `Newer` of wire.py, compiled: the same bytes and the same frames. wire.py is the truth
// and uses this only beside the very file that it was made from (see native_code.py).

#define PY_SSIZE_T_CLEAN
#include <Python.h>
#include <structmember.h>

enum { MARKER_V1 = 0xFE, MARKER_V2 = 0xFD, HEAD_V1 = 6, HEAD_V2 = 10, CHECK = 2 };
enum { SIGNED = 1, SIGNATURE = 13, LONGEST_PAYLOAD = 255, FIELDS = 6 };

// CRC-16/MCRF4XX, four bytes at a time: a table for each place (M. E. Kounavis and F. L. Berry, "A
// systematic approach to building high performance software-based CRC generators", 2005).
static uint16_t crc_tables[4][256];

static void make_crc_tables(void)
{
    for (int byte = 0; byte < 256; byte++) {
        uint16_t crc = (uint16_t)byte;
        for (int bit = 0; bit < 8; bit++)
            crc = (uint16_t)(crc & 1 ? crc >> 1 ^ 0x8408 : crc >> 1);
        crc_tables[0][byte] = crc;
    }
    for (int place = 1; place < 4; place++)
        for (int byte = 0; byte < 256; byte++) {
            uint16_t crc = crc_tables[place - 1][byte];
            crc_tables[place][byte] = (uint16_t)(crc >> 8 ^ crc_tables[0][crc & 0xFF]);
        }
}

static uint16_t crc16(uint16_t crc, const uint8_t *data, Py_ssize_t count)
{
    for (; count >= 4; data += 4, count -= 4)
        crc = crc_tables[3][data[0] ^ (crc & 0xFF)] ^ crc_tables[2][data[1] ^ (crc >> 8)] ^
              crc_tables[1][data[2]] ^ crc_tables[0][data[3]];
    for (; count > 0; data++, count--)
        crc = (uint16_t)(crc >> 8 ^ crc_tables[0][(crc ^ *data) & 0xFF]);
    return crc;
}

// The byte that a message adds to its checksum: -1 when the dialect does not know the message, -2
// with an exception set.
static int extra_of(PyObject *extras, long message_id)
{
    PyObject *number = PyLong_FromLong(message_id);
    if (number == NULL)
        return -2;
    PyObject *extra = PyDict_GetItemWithError(extras, number);
    Py_DECREF(number);
    if (extra == NULL)
        return PyErr_Occurred() ? -2 : -1;
    if (!PyBytes_Check(extra) || PyBytes_GET_SIZE(extra) != 1) {
        PyErr_SetString(PyExc_TypeError, "expected one byte per message");
        return -2;
    }
    return (uint8_t)PyBytes_AS_STRING(extra)[0];
}

// A frame: `numbers` are sequence, system, component and message, all in range.
static PyObject *framed(const long *numbers, uint8_t extra, const uint8_t *payload,
                        Py_ssize_t length)
{
    while (length > 0 && payload[length - 1] == 0)
        length--;
    if (length > LONGEST_PAYLOAD) {
        PyErr_SetString(PyExc_ValueError, "the payload is longer than a frame can be");
        return NULL;
    }
    uint8_t frame[HEAD_V2 + LONGEST_PAYLOAD + CHECK] = {
        MARKER_V2, (uint8_t)(length ? length : 1), 0, 0, (uint8_t)numbers[0], (uint8_t)numbers[1],
        (uint8_t)numbers[2], (uint8_t)numbers[3], (uint8_t)(numbers[3] >> 8),
        (uint8_t)(numbers[3] >> 16),
    };
    memcpy(frame + HEAD_V2, payload, (size_t)length);
    Py_ssize_t end = HEAD_V2 + (length ? length : 1);
    uint16_t crc = crc16(crc16(0xFFFF, frame + 1, end - 1), &extra, 1);
    frame[end] = (uint8_t)crc;
    frame[end + 1] = (uint8_t)(crc >> 8);
    return PyBytes_FromStringAndSize((const char *)frame, end + CHECK);
}

static PyObject *wire_pack(PyObject *module, PyObject *const *arguments, Py_ssize_t count)
{
    // extras, sequence, system_id, component_id, message_id, payload
    if (count != 6 || !PyDict_Check(arguments[0]) || !PyBytes_Check(arguments[5])) {
        PyErr_SetString(PyExc_TypeError, "expected the extra bytes, four numbers and a payload");
        return NULL;
    }
    long numbers[4];
    for (int i = 0; i < 4; i++) {
        numbers[i] = PyLong_AsLong(arguments[i + 1]);
        if (numbers[i] == -1 && PyErr_Occurred())
            return NULL;
        if (numbers[i] < 0 || numbers[i] > (i < 3 ? 0xFF : 0xFFFFFF)) {
            PyErr_SetString(PyExc_ValueError, "a number does not fit into the head of a frame");
            return NULL;
        }
    }
    int extra = extra_of(arguments[0], numbers[3]);
    if (extra == -2)
        return NULL;
    if (extra == -1) {
        PyErr_SetObject(PyExc_KeyError, arguments[4]);
        return NULL;
    }
    return framed(numbers, (uint8_t)extra, (const uint8_t *)PyBytes_AS_STRING(arguments[5]),
                  PyBytes_GET_SIZE(arguments[5]));
}

// A `Frame`, which is a tuple with names.
static PyObject *frame_of(PyTypeObject *type, const long *numbers, const char *payload,
                          Py_ssize_t length, const char *raw, Py_ssize_t size)
{
    PyObject *frame = type->tp_alloc(type, FIELDS);
    if (frame == NULL)
        return NULL;
    for (int i = 0; i < 4; i++)
        PyTuple_SET_ITEM(frame, i, PyLong_FromLong(numbers[i]));
    PyTuple_SET_ITEM(frame, 4, PyBytes_FromStringAndSize(payload, length));
    PyTuple_SET_ITEM(frame, 5, PyBytes_FromStringAndSize(raw, size));
    for (int i = 0; i < FIELDS; i++)
        if (PyTuple_GET_ITEM(frame, i) == NULL) {
            Py_DECREF(frame);
            return NULL;
        }
    return frame;
}

static PyObject *wire_split(PyObject *module, PyObject *const *arguments, Py_ssize_t count)
{
    // extras, the class of frames, the longest datagram, datagram
    if (count != 4 || !PyDict_Check(arguments[0]) || !PyType_Check(arguments[1]) ||
        !PyType_IsSubtype((PyTypeObject *)arguments[1], &PyTuple_Type) ||
        !PyLong_Check(arguments[2]) || !PyBytes_Check(arguments[3])) {
        PyErr_SetString(PyExc_TypeError, "expected extra bytes, a tuple class, a size, a datagram");
        return NULL;
    }
    const uint8_t *data = (const uint8_t *)PyBytes_AS_STRING(arguments[3]);
    Py_ssize_t end = PyBytes_GET_SIZE(arguments[3]), start = 0;
    if (end > PyLong_AsLong(arguments[2]))
        end = 0;
    PyObject *frames = PyList_New(0);
    while (frames != NULL && end - start >= 8) {
        const uint8_t *at = data + start;
        long numbers[4]; // message, sequence, system, component
        Py_ssize_t head, tail = CHECK, length = at[1];
        int known = 1;
        if (at[0] == MARKER_V2 && end - start >= 12) {
            head = HEAD_V2;
            known = (at[2] & ~SIGNED) == 0;
            tail += at[2] & SIGNED ? SIGNATURE : 0;
            numbers[0] = at[7] | at[8] << 8 | at[9] << 16;
            numbers[1] = at[4], numbers[2] = at[5], numbers[3] = at[6];
        } else if (at[0] == MARKER_V1) {
            head = HEAD_V1;
            numbers[0] = at[5], numbers[1] = at[2], numbers[2] = at[3], numbers[3] = at[4];
        } else {
            start++;
            continue;
        }
        if (known && start + head + length + tail <= end) {
            int extra = extra_of(arguments[0], numbers[0]);
            if (extra == -2) {
                Py_CLEAR(frames);
                break;
            }
            uint8_t last = (uint8_t)extra;
            uint16_t crc = crc16(crc16(0xFFFF, at + 1, head - 1 + length), &last, 1);
            const uint8_t *check = at + head + length;
            if (extra >= 0 && crc == (check[0] | check[1] << 8)) {
                PyObject *frame =
                    frame_of((PyTypeObject *)arguments[1], numbers, (const char *)at + head,
                             length, (const char *)at, head + length + tail);
                if (frame == NULL || PyList_Append(frames, frame) < 0)
                    Py_CLEAR(frames);
                Py_XDECREF(frame);
                start += head + length + tail;
                continue;
            }
        }
        start++;
    }
    PyObject *each = frames == NULL ? NULL : PyObject_GetIter(frames);
    Py_XDECREF(frames);
    return each;
}

// Layout ---------------------------------------------------------------------------------------

enum { MOST_FIELDS = 32 };

typedef struct {
    PyObject_HEAD
    long message_id;
    Py_ssize_t size, fields;
    uint8_t extra;
    char code[MOST_FIELDS];     // as `struct` names them: f, or an integer, or s
    Py_ssize_t at[MOST_FIELDS]; // where the field lies in the payload
    Py_ssize_t width[MOST_FIELDS];
} Layout;

static PyObject *struct_error, *name_seq, *name_system, *name_component;

static int layout_init(Layout *self, PyObject *arguments, PyObject *keywords)
{
    const char *format;
    if (keywords != NULL || !PyArg_ParseTuple(arguments, "lbs", &self->message_id, &self->extra,
                                              &format))
        return -1;
    self->size = self->fields = 0;
    if (*format++ != '<')
        goto unknown;
    while (*format) {
        Py_ssize_t count = 0;
        for (; *format >= '0' && *format <= '9'; format++)
            count = 10 * count + *format - '0';
        const char *known = strchr("BHIifs", *format);
        if (*format == 0 || known == NULL)
            goto unknown;
        Py_ssize_t width = *known == 'B' ? 1 : *known == 'H' ? 2 : 4, times = count ? count : 1;
        if (*known == 's')
            width = times, times = 1;
        for (; times > 0; times--) {
            if (self->fields == MOST_FIELDS || self->size + width > LONGEST_PAYLOAD)
                goto unknown;
            self->code[self->fields] = *known;
            self->at[self->fields] = self->size;
            self->width[self->fields++] = width;
            self->size += width;
        }
        format++;
    }
    return 0;
unknown:
    PyErr_SetString(PyExc_ValueError, "a layout of a kind that is not known here");
    return -1;
}

// Pack a field, -1 with `struct`'s exceptions set where it does not fit.
static int put(uint8_t *to, char code, Py_ssize_t width, PyObject *value)
{
    if (code == 's') {
        if (!PyBytes_Check(value)) {
            PyErr_SetString(struct_error, "argument for 's' must be a bytes object");
            return -1;
        }
        Py_ssize_t length = PyBytes_GET_SIZE(value);
        memcpy(to, PyBytes_AS_STRING(value), (size_t)(length < width ? length : width));
        return 0;
    }
    if (code == 'f') {
        double number = PyFloat_AsDouble(value);
        if (number == -1.0 && PyErr_Occurred()) {
            PyErr_SetString(struct_error, "required argument is not a float");
            return -1;
        }
        return PyFloat_Pack4(number, (char *)to, 1);
    }
    long long low = code == 'i' ? -2147483648LL : 0;
    long long high = code == 'i' ? 2147483647LL : (1LL << 8 * width) - 1;
    long long number = PyLong_AsLongLong(value);
    if ((number == -1 && PyErr_Occurred()) || number < low || number > high) {
        PyErr_SetString(struct_error, "required argument is no integer in range");
        return -1;
    }
    for (Py_ssize_t i = 0; i < width; i++)
        to[i] = (uint8_t)(number >> 8 * i);
    return 0;
}

static PyObject *layout_frame(Layout *self, PyObject *const *arguments, Py_ssize_t count)
{
    // sequence, fields in wire order
    if (count != self->fields + 1) {
        PyErr_SetString(struct_error, "expected a sequence and every field");
        return NULL;
    }
    PyObject *const names[3] = {name_seq, name_system, name_component};
    long numbers[4];
    numbers[3] = self->message_id;
    for (int i = 0; i < 3; i++) {
        PyObject *value = PyObject_GetAttr(arguments[0], names[i]);
        if (value == NULL)
            return NULL;
        numbers[i] = PyLong_AsLong(value);
        Py_DECREF(value);
        if (numbers[i] == -1 && PyErr_Occurred())
            return NULL;
        if (numbers[i] < 0 || numbers[i] > 0xFF) {
            PyErr_SetString(PyExc_ValueError, "a number does not fit into the head of a frame");
            return NULL;
        }
    }
    PyObject *next = PyLong_FromLong((numbers[0] + 1) & 0xFF);
    if (next == NULL || PyObject_SetAttr(arguments[0], name_seq, next) < 0) {
        Py_XDECREF(next);
        return NULL;
    }
    Py_DECREF(next);
    uint8_t payload[LONGEST_PAYLOAD] = {0};
    for (Py_ssize_t i = 0; i < self->fields; i++)
        if (put(payload + self->at[i], self->code[i], self->width[i], arguments[i + 1]) < 0)
            return NULL;
    return framed(numbers, self->extra, payload, self->size);
}

static PyObject *field(const uint8_t *from, char code, Py_ssize_t width)
{
    if (code == 's')
        return PyBytes_FromStringAndSize((const char *)from, width);
    if (code == 'f') {
        double number = PyFloat_Unpack4((const char *)from, 1);
        return number == -1.0 && PyErr_Occurred() ? NULL : PyFloat_FromDouble(number);
    }
    uint32_t number = 0;
    for (Py_ssize_t i = 0; i < width; i++)
        number |= (uint32_t)from[i] << 8 * i;
    return code == 'i' ? PyLong_FromLong((int32_t)number) : PyLong_FromUnsignedLong(number);
}

static PyObject *layout_unpack(Layout *self, PyObject *payload)
{
    if (!PyBytes_Check(payload)) {
        PyErr_SetString(PyExc_TypeError, "expected bytes");
        return NULL;
    }
    uint8_t whole[LONGEST_PAYLOAD] = {0};
    Py_ssize_t length = PyBytes_GET_SIZE(payload);
    memcpy(whole, PyBytes_AS_STRING(payload), (size_t)(length < self->size ? length : self->size));
    PyObject *found = PyTuple_New(self->fields);
    for (Py_ssize_t i = 0; found != NULL && i < self->fields; i++) {
        PyObject *value = field(whole + self->at[i], self->code[i], self->width[i]);
        if (value == NULL)
            Py_CLEAR(found);
        else
            PyTuple_SET_ITEM(found, i, value);
    }
    return found;
}

static PyMemberDef layout_members[] = {
    {"message_id", T_LONG, offsetof(Layout, message_id), READONLY, NULL},
    {"size", T_PYSSIZET, offsetof(Layout, size), READONLY, NULL}, {NULL},
};

static PyMethodDef layout_methods[] = {
    {"frame", (PyCFunction)(void (*)(void))layout_frame, METH_FASTCALL, NULL},
    {"unpack", (PyCFunction)layout_unpack, METH_O, NULL}, {NULL},
};

static PyTypeObject LayoutType = {
    PyVarObject_HEAD_INIT(NULL, 0).tp_name = "aurora_uav_wire.Layout",
    .tp_basicsize = sizeof(Layout), .tp_flags = Py_TPFLAGS_DEFAULT, .tp_new = PyType_GenericNew,
    .tp_init = (initproc)layout_init, .tp_members = layout_members, .tp_methods = layout_methods,
};

// Newer ----------------------------------------------------------------------------------------

typedef struct {
    PyObject_HEAD
    PyObject *last; // sequence of the newest frame by sender
} Newer;

static PyObject *newer_new(PyTypeObject *type, PyObject *arguments, PyObject *keywords)
{
    if (PyTuple_GET_SIZE(arguments) != 0 || keywords != NULL) {
        PyErr_SetString(PyExc_TypeError, "expected no arguments");
        return NULL;
    }
    Newer *self = (Newer *)type->tp_alloc(type, 0);
    if (self != NULL && (self->last = PyDict_New()) == NULL)
        Py_CLEAR(self);
    return (PyObject *)self;
}

static void newer_dealloc(Newer *self)
{
    Py_CLEAR(self->last);
    Py_TYPE(self)->tp_free((PyObject *)self);
}

static PyObject *newer_accept(Newer *self, PyObject *frame)
{
    if (!PyTuple_Check(frame) || PyTuple_GET_SIZE(frame) != FIELDS) {
        PyErr_SetString(PyExc_TypeError, "expected a frame");
        return NULL;
    }
    long sequence = PyLong_AsLong(PyTuple_GET_ITEM(frame, 1));
    long system = PyLong_AsLong(PyTuple_GET_ITEM(frame, 2));
    long component = PyLong_AsLong(PyTuple_GET_ITEM(frame, 3));
    PyObject *sender = PyErr_Occurred() ? NULL : PyLong_FromLong(system << 8 | component);
    if (sender == NULL)
        return NULL;
    PyObject *last = PyDict_GetItemWithError(self->last, sender);
    long ahead = last == NULL ? 1 : (sequence - PyLong_AsLong(last)) & 0xFF;
    int newer = 0 < ahead && ahead < 128;
    int failed = PyErr_Occurred() != NULL ||
                 (newer && PyDict_SetItem(self->last, sender, PyTuple_GET_ITEM(frame, 1)) < 0);
    Py_DECREF(sender);
    return failed ? NULL : PyBool_FromLong(newer);
}

static PyMethodDef newer_methods[] = {{"accept", (PyCFunction)newer_accept, METH_O, NULL}, {NULL}};

static PyTypeObject NewerType = {
    PyVarObject_HEAD_INIT(NULL, 0).tp_name = "aurora_uav_wire.Newer",
    .tp_basicsize = sizeof(Newer), .tp_flags = Py_TPFLAGS_DEFAULT, .tp_new = newer_new,
    .tp_dealloc = (destructor)newer_dealloc, .tp_methods = newer_methods,
};

static PyMethodDef methods[] = {
    {"pack", (PyCFunction)(void (*)(void))wire_pack, METH_FASTCALL, NULL},
    {"split", (PyCFunction)(void (*)(void))wire_split, METH_FASTCALL, NULL},
    {NULL},
};

static struct PyModuleDef module = {
    PyModuleDef_HEAD_INIT, "aurora_uav_wire", "pack, split and the layouts of wire.py, compiled.", -1,
    methods, NULL, NULL, NULL, NULL,
};

PyMODINIT_FUNC PyInit_aurora_uav_wire(void)
{
    make_crc_tables();
    PyObject *of = PyImport_ImportModule("struct");
    struct_error = of == NULL ? NULL : PyObject_GetAttrString(of, "error");
    Py_XDECREF(of);
    name_seq = PyUnicode_InternFromString("seq");
    name_system = PyUnicode_InternFromString("srcSystem");
    name_component = PyUnicode_InternFromString("srcComponent");
    if (struct_error == NULL || name_seq == NULL || name_system == NULL || name_component == NULL ||
        PyType_Ready(&LayoutType) < 0 || PyType_Ready(&NewerType) < 0)
        return NULL;
    PyObject *made = PyModule_Create(&module);
    if (made == NULL || PyModule_AddStringConstant(made, "EQUAL_TO", EQUAL_TO) < 0 ||
        PyModule_AddStringConstant(made, "SOURCES", SOURCES) < 0 ||
        PyModule_AddObjectRef(made, "Layout", (PyObject *)&LayoutType) < 0 ||
        PyModule_AddObjectRef(made, "Newer", (PyObject *)&NewerType) < 0) {
        Py_XDECREF(made);
        return NULL;
    }
    return made;
}
