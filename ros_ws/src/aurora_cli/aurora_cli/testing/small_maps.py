# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Small OpenStreetMap and OpenDRIVE files, written by tests that import them."""

from __future__ import annotations

# A grid of 3 by 3 streets, 150 m apart, at 60 degrees north, far from the middle of its UTM zone.
LAT, LON = 60.17, 24.94
STEP_LAT, STEP_LON = 150.0 / 111_412.0, 150.0 / 55_520.0


def _tags(**tags: object) -> str:
    return ''.join(
        f'<tag k="{key.replace("__", ":")}" v="{value}"/>' for key, value in tags.items()
    )


class Osm:
    """Writes an extract; places are counted in blocks of the grid from its south-west corner."""

    def __init__(self) -> None:
        self._nodes: list[str] = []
        self._rest: list[str] = []
        self._next = 1

    def node(self, east: float, north: float, **tags: object) -> int:
        """Add a node, return its id; `__` in the name of a tag stands for a colon."""
        lat, lon = LAT + north * STEP_LAT, LON + east * STEP_LON
        self._next += 1
        self._nodes.append(
            f'<node id="{self._next}" lat="{lat:.8f}" lon="{lon:.8f}">{_tags(**tags)}</node>'
        )
        return self._next

    def way(self, nodes: list[int], **tags: object) -> int:
        """Add a way, return its id."""
        self._next += 1
        ring = ''.join(f'<nd ref="{n}"/>' for n in nodes)
        self._rest.append(f'<way id="{self._next}">{ring}{_tags(**tags)}</way>')
        return self._next

    def box(self, east: float, north: float, size: float, **tags: object) -> int:
        """Add a square by its south-west corner, return its id."""
        corners = [(0, 0), (size, 0), (size, size), (0, size)]
        nodes = [self.node(east + x, north + y) for x, y in corners]
        return self.way([*nodes, nodes[0]], **tags)

    def hole(self, outer: int, inner: int, **tags: object) -> None:
        """Add a multipolygon of two rings."""
        members = f'<member type="way" ref="{outer}" role="outer"/>'
        members += f'<member type="way" ref="{inner}" role="inner"/>'
        tags = {'type': 'multipolygon', **tags}
        self._rest.append(f'<relation id="1">{members}{_tags(**tags)}</relation>')

    def text(self) -> str:
        """Return the extract."""
        body = '\n'.join((*self._nodes, *self._rest))
        return f'<?xml version="1.0"?>\n<osm version="0.6">\n{body}\n</osm>\n'


def small_city() -> str:
    """Streets, signals, buildings with and without heights, a park, a hospital, a bus stop."""
    osm = Osm()
    light = {'highway': 'traffic_signals'}
    grid = {(i, j): osm.node(i, j, **(light if i == j == 1 else {}))
            for i in range(3) for j in range(3)}  # fmt: skip
    for k in range(3):
        wide = {'lanes': 4} if k == 1 else {}
        osm.way([grid[i, k] for i in range(3)], highway='secondary', name=f'Row {k}', **wide)
        osm.way([grid[k, j] for j in range(3)], highway='residential', name=f'Läntinen {k}')
    osm.way([osm.node(0.2, 0.2), osm.node(0.8, 0.8)], highway='footway')
    osm.box(0.3, 0.3, 0.2, building='yes', height='12.5 m', name='Grönqvist House')
    osm.box(0.6, 0.3, 0.2, building='yes', building__levels=4)
    osm.box(0.3, 0.6, 0.2, building='garage')
    osm.box(0.6, 0.6, 0.2, building='yes', layer=-1)
    osm.box(1.3, 0.3, 0.3, building='hospital', amenity='hospital', name='Saint Anna Hospital')
    osm.box(1.2, 1.2, 0.6, leisure='park', name='Meadow Park')
    osm.box(1.05, 1.85, 0.1, highway='pedestrian', area='yes', name='Corn Market')
    lane = [osm.node(1.3 + x, 0.7 + y) for x, y in ((0, 0), (0.5, 0), (0.5, 0.05), (0, 0.05))]
    osm.way([*lane, lane[0]], highway='pedestrian', area='yes', name='Shoe Lane')
    osm.box(0.95, 1.4, 0.1, building='yes', height=20)  # across the middle street
    outer, inner = osm.box(0.2, 1.2, 0.6), osm.box(0.3, 1.3, 0.3)
    osm.hole(outer, inner, building='yes', building__levels=2, name='Taxi')
    osm.node(1.5, 1.06, highway='bus_stop', name='Row One')
    osm.node(1.5, 0.1, railway='station', name='Smallham', addr__city='Smallham')
    osm.node(1.7, 1.5, tourism='museum', name='Old\u202eTown\nMuseum')
    return osm.text()


XODR = """<?xml version="1.0"?>
<OpenDRIVE>
  <header revMajor="1" revMinor="4" name="" version="1" north="0" south="0" east="0" west="0"/>
  <road name="Long Road" length="300" id="1" junction="-1">
    <link/>
    <planView>
      <geometry s="0" x="1000" y="2000" hdg="0.5" length="300"><line/></geometry>
    </planView>
    <lanes>
      <laneSection s="0">
        <left>{sidewalk_left}
          <lane id="1" type="driving" level="false"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          </lane>
        </left>
        <center><lane id="0" type="none" level="false"/></center>
        <right>
          <lane id="-1" type="driving" level="false"><width sOffset="0" a="3.5" b="0" c="0" d="0"/>
          </lane>{sidewalk_right}
        </right>
      </laneSection>
    </lanes>
  </road>
</OpenDRIVE>
"""
_WALK = (
    '<lane id="{}" type="sidewalk" level="false">'
    '<width sOffset="0" a="2" b="0" c="0" d="0"/></lane>'
)


def xodr(*, walkways: bool) -> str:
    """One straight road, 1 and 2 km away from the origin of the file."""
    left, right = (_WALK.format(2), _WALK.format(-2)) if walkways else ('', '')
    return XODR.format(sidewalk_left=left, sidewalk_right=right)
