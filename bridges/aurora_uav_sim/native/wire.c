// SPDX-FileCopyrightText: 2026 The AURORA authors
// SPDX-License-Identifier: Apache-2.0
//
// `pack` and `split` of wire.py, compiled: the same bytes and the same frames. wire.py is the truth
// and uses this only beside the very file that it was made from (see native_code.py).

#define PY_SSIZE_T_CLEAN
#include <Python.h>

enum { MARKER_V1 = 0xFE, MARKER_V2 = 0xFD, HEAD_V1 = 6, HEAD_V2 = 10, CHECK = 2 };
enum { SIGNED = 1, SIGNATURE = 13, LONGEST_PAYLOAD = 255, FIELDS = 6 };

// CRC-16/MCRF4XX
static uint16_t crc16(uint16_t crc, const uint8_t *data, Py_ssize_t count)
{
    for (Py_ssize_t i = 0; i < count; i++) {
        uint8_t mixed = data[i] ^ (uint8_t)crc;
        mixed ^= (uint8_t)(mixed << 4);
        crc = (uint16_t)((crc >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4));
    }
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
    const uint8_t *payload = (const uint8_t *)PyBytes_AS_STRING(arguments[5]);
    Py_ssize_t length = PyBytes_GET_SIZE(arguments[5]);
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
    uint8_t last = (uint8_t)extra;
    uint16_t crc = crc16(crc16(0xFFFF, frame + 1, end - 1), &last, 1);
    frame[end] = (uint8_t)crc;
    frame[end + 1] = (uint8_t)(crc >> 8);
    return PyBytes_FromStringAndSize((const char *)frame, end + CHECK);
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

static PyMethodDef methods[] = {
    {"pack", (PyCFunction)(void (*)(void))wire_pack, METH_FASTCALL, NULL},
    {"split", (PyCFunction)(void (*)(void))wire_split, METH_FASTCALL, NULL},
    {NULL},
};

static struct PyModuleDef module = {
    PyModuleDef_HEAD_INIT, "aurora_uav_wire", "pack and split of wire.py, compiled.", -1, methods,
    NULL, NULL, NULL, NULL,
};

PyMODINIT_FUNC PyInit_aurora_uav_wire(void)
{
    PyObject *made = PyModule_Create(&module);
    if (made == NULL || PyModule_AddStringConstant(made, "EQUAL_TO", EQUAL_TO) < 0 ||
        PyModule_AddStringConstant(made, "SOURCES", SOURCES) < 0) {
        Py_XDECREF(made);
        return NULL;
    }
    return made;
}
