"""Scenes: example models, each in a file to copy and modify."""

from acausal import Model
from models.blade import Blade
from models.bricard import Bricard
from models.car_axis import CarAxis
from models.fe_pendulum import FEPendulum
from models.fe_plate import FEPlate
from models.four_bar import FourBar
from models.four_bar_spatial import FourBarSpatial
from models.free_vibration import FreeVibration
from models.governor import Governor
from models.n_four_bar import NFourBar
from models.pendulum import FlexiblePendulum
from models.right_angle_frame import RightAngleFrame
from models.robot_arm import RobotArm
from models.rolling_wheel_set_driving import RollingWheelSetDriving
from models.shaft import Shaft
from models.simple_pendulum import SimplePendulum
from models.slider_crank import SliderCrank
from models.spin_up import SpinUp
from models.squeezer import Squeezer

SCENES: dict[str, type[Model]] = {
    "free-vibration": FreeVibration,
    "pendulum": FlexiblePendulum,
    "spin-up": SpinUp,
    "slider-crank": SliderCrank,
    "simple-pendulum": SimplePendulum,
    "n-four-bar": NFourBar,
    "squeezer": Squeezer,
    "bricard": Bricard,
    "governor": Governor,
    "car-axis": CarAxis,
    "four-bar": FourBar,
    "four-bar-spatial": FourBarSpatial,
    "blade": Blade,
    "right-angle-frame": RightAngleFrame,
    "shaft": Shaft,
    "robot-arm": RobotArm,
    "fe-pendulum": FEPendulum,
    "fe-plate": FEPlate,
    "rolling-wheel-set-driving": RollingWheelSetDriving,
}

__all__ = [
    "SCENES",
    "Blade",
    "Bricard",
    "CarAxis",
    "FEPendulum",
    "FEPlate",
    "FlexiblePendulum",
    "FourBar",
    "FourBarSpatial",
    "FreeVibration",
    "Governor",
    "NFourBar",
    "RightAngleFrame",
    "RobotArm",
    "RollingWheelSetDriving",
    "Shaft",
    "SimplePendulum",
    "SliderCrank",
    "SpinUp",
    "Squeezer",
]
