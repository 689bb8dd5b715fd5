"""The device's side of usbredir, the protocol by which QEMU uses USB devices of other processes or machines.

Source: usbredirproto.h of the usbredir project. Numbers are little endian. A packet is a header
(type, length, id) and its payload. Ids have 32 bits until both sides have sent HELLO, then 64 bits.
"""

import socket
import struct
import threading

HELLO, DEVICE_CONNECT, DEVICE_DISCONNECT, RESET = 0, 1, 2, 3
INTERFACE_INFO, EP_INFO = 4, 5
SET_CONFIGURATION, GET_CONFIGURATION, CONFIGURATION_STATUS = 6, 7, 8
SET_ALT_SETTING, GET_ALT_SETTING, ALT_SETTING_STATUS = 9, 10, 11
CANCEL_DATA_PACKET = 21
CONTROL_PACKET, BULK_PACKET = 100, 101

# Bits for connect_device_version, ep_info_max_packet_size, 64bits_ids and 32bits_bulk_length.
CAPABILITIES = 1 << 1 | 1 << 4 | 1 << 5 | 1 << 6

SUCCESS, CANCELLED, STALL = 0, 1, 4
HIGH_SPEED = 2
CONTROL_TYPE, BULK_TYPE, NO_ENDPOINT = 0, 2, 255


class UsbRedirLink:
    """One connection to QEMU. It handles QEMU's packets by calls of `device`: connected(), control(),
    bulk_requested() and bulk_cancelled()."""

    def __init__(self, connection, device):
        self._connection = connection
        self._device = device
        self._sending = threading.Lock()
        self._header = struct.Struct('<III')

    def send(self, kind, ident, payload):
        """Sends one packet. Thread-safe."""
        with self._sending:
            self._connection.sendall(self._header.pack(kind, len(payload), ident) + payload)

    def run(self):
        """Receives and handles packets until QEMU ends."""
        self.send(HELLO, 0, b'mfar test bed'.ljust(64, b'\0') + struct.pack('<I', CAPABILITIES))
        try:
            while True:
                kind, length, ident = self._header.unpack(self._receive(self._header.size))
                self._handle(kind, ident, self._receive(length))
        except (EOFError, ConnectionError, OSError):
            pass

    def _receive(self, count):
        data = bytearray()
        while len(data) < count:
            part = self._connection.recv(count - len(data))
            if not part:
                raise EOFError
            data += part
        return bytes(data)

    def _handle(self, kind, ident, payload):
        if kind == HELLO:
            self._header = struct.Struct('<IIQ')
            self._device.connected()
        elif kind == SET_CONFIGURATION:
            self.send(CONFIGURATION_STATUS, ident, bytes([SUCCESS, payload[0]]))
        elif kind == GET_CONFIGURATION:
            self.send(CONFIGURATION_STATUS, ident, bytes([SUCCESS, 1]))
        elif kind in (SET_ALT_SETTING, GET_ALT_SETTING):
            self.send(ALT_SETTING_STATUS, ident, bytes([SUCCESS, payload[0], 0]))
        elif kind == CONTROL_PACKET:
            self._control(ident, payload)
        elif kind == BULK_PACKET:
            _, _, low, _, high = struct.unpack_from('<BBHIH', payload)
            self._device.bulk_requested(ident, low | high << 16)
        elif kind == CANCEL_DATA_PACKET and self._device.bulk_cancelled(ident):
            self.send_bulk(ident, b'', CANCELLED)

    def _control(self, ident, payload):
        endpoint, request, kind, _, value, index, length = struct.unpack_from('<BBBBHHH', payload)
        answer = self._device.control(kind, request, value, index, payload[10:])
        status = SUCCESS if answer is not None else STALL
        answer = (answer or b'')[:length] if kind & 0x80 else b''
        size = len(answer) if kind & 0x80 else length
        self.send(CONTROL_PACKET, ident, struct.pack('<BBBBHHH', endpoint, request, kind, status,
                                                     value, index, size) + answer)

    def send_bulk(self, ident, data, status=SUCCESS):
        """Answers a request for data from endpoint 0x81."""
        header = struct.pack('<BBHIH', 0x81, status, len(data) & 0xffff, 0, len(data) >> 16)
        self.send(BULK_PACKET, ident, header + bytes(data))

    def plug(self, device_class, vendor, product, bulk_packet):
        """Plugs in a device that has a control endpoint and, in interface 1, the bulk endpoint 0x81."""
        kinds, interfaces, sizes = [NO_ENDPOINT] * 32, [0] * 32, [0] * 32
        kinds[0] = kinds[16] = CONTROL_TYPE
        sizes[0] = sizes[16] = 64
        kinds[17], interfaces[17], sizes[17] = BULK_TYPE, 1, bulk_packet
        self.send(EP_INFO, 0, bytes(kinds) + bytes(32) + bytes(interfaces)
                  + struct.pack('<32H', *sizes))
        self.send(INTERFACE_INFO, 0, struct.pack('<I', 2) + bytes([0, 1]).ljust(32, b'\0')
                  + bytes([14, 14]).ljust(32, b'\0') + bytes([1, 2]).ljust(32, b'\0') + bytes(32))
        self.send(DEVICE_CONNECT, 0, bytes([HIGH_SPEED, *device_class])
                  + struct.pack('<HHH', vendor, product, 0x0100))

    def unplug(self):
        self.send(DEVICE_DISCONNECT, 0, b'')


def serve(path, device_of_link):
    """Starts a thread that waits on a socket file for one QEMU and then handles its packets."""
    listener = socket.socket(socket.AF_UNIX)
    listener.bind(path)
    listener.listen(1)

    def wait():
        connection, _ = listener.accept()
        listener.close()
        device = device_of_link(connection)
        device.link.run()

    thread = threading.Thread(target=wait, daemon=True)
    thread.start()
    return thread
