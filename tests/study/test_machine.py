import json

import numba
from threadpoolctl import threadpool_info

from suspension_ctrl.study import machine as environment


def test_thread_pools_are_held_at_one_and_released():
    before = numba.get_num_threads(), [pool["num_threads"] for pool in threadpool_info()]
    with environment.single_thread():
        assert numba.get_num_threads() == 1
        assert {pool["num_threads"] for pool in threadpool_info()} == {1}
    assert (numba.get_num_threads(), [pool["num_threads"] for pool in threadpool_info()]) == before


def test_record_says_what_ran_and_holds_no_path():
    with environment.single_thread():
        record = environment.describe({"seed": 3})
    assert record["threads"]["numba"] == 1
    assert all(pool["num_threads"] == 1 for pool in record["threads"]["pools"])
    assert set(record["versions"]) >= {"control", "deap", "numpy", "moocore"}
    assert record["processor"]
    assert json.loads(json.dumps(record))["arguments"] == {"seed": 3}
    assert "site-packages" not in json.dumps(record)
