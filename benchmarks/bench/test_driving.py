"""Force laws in time: 20 km on a road of class C at 30 m/s, and the peaks of 100 designs over a speed bump.

Nothing is asserted about the times. Compiling is not in them.
"""

import numpy as np
import pytest

import suspension_ctrl as sc
from suspension_ctrl.response.peaks import peaks
from suspension_ctrl.study import machine as environment

SPEED, DESIGNS = 30.0, 100
BUMP = sc.SpeedBump(height=0.05, length=1.0)
TABLE = sc.TableDamper(velocity=[-1.15, -0.15, 0.0, 0.1, 1.1], force=[-725.0, -225.0, 0.0, 500.0, 1700.0])
QUARTER = sc.QuarterCar(
    body_mass=317.5, wheel_mass=45.4, tyre_stiffness=192e3, strut=sc.parallel(sc.Spring(), TABLE)
)


@pytest.fixture(autouse=True)
def one_thread():
    with environment.single_thread():
        yield


@pytest.mark.benchmark(group="20 km in time")
@pytest.mark.parametrize("name", ["quarter car with a table", "volvo_xc90_full"])
def test_20_km(benchmark, name):
    file = sc.load_vehicle("volvo_xc90_full") if name.startswith("volvo") else None
    car, setting = (file.vehicle, file.setting) if file else (QUARTER, {"spring": 22e3})
    tracks = np.unique(car.contact_points[:, 1])
    short, long = (sc.Iso8608Road("C").profile(length, 0.05, seed=1, tracks=tracks) for length in (100.0, 20e3))
    sc.simulate(car, setting, short, SPEED)
    table = benchmark.pedantic(sc.simulate, (car, setting, long, SPEED), rounds=3)
    assert np.isfinite(table.to_numpy()).all()


@pytest.mark.benchmark(group=f"{DESIGNS} designs over a speed bump")
@pytest.mark.parametrize("name", ["jian_2022_full", "volvo_xc90_digressive"])
def test_peaks_of_travel(benchmark, name):
    """Straight struts by the frequency response of the event, force laws driven one by one."""
    file, seeds = sc.load_vehicle(name), iter(range(100))
    values = np.array(list(file.vehicle.coefficients(file.setting).values()))
    travels = [one for one in file.vehicle.responses if one.endswith("suspension_travel")]

    def others():
        """Designs that were not asked for before."""
        factors = np.random.default_rng(next(seeds)).uniform(0.9, 1.1, (DESIGNS, values.size))
        return (file.vehicle, factors * values, BUMP, 5.0, travels), {}

    peaks(*others()[0])
    highest, lowest = benchmark.pedantic(peaks, setup=others, rounds=5)
    assert (highest > lowest).all()
