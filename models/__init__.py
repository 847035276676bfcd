"""Scenes: example models, each in a file to copy and modify."""

from acausal import Model
from models.blade import Blade as Blade
from models.bricard import Bricard as Bricard
from models.car_axis import CarAxis as CarAxis
from models.fe_pendulum import FEPendulum as FEPendulum
from models.fe_plate import FEPlate as FEPlate
from models.four_bar import FourBar as FourBar
from models.four_bar_spatial import FourBarSpatial as FourBarSpatial
from models.free_vibration import FreeVibration as FreeVibration
from models.governor import Governor as Governor
from models.n_four_bar import NFourBar as NFourBar
from models.pendulum import FlexiblePendulum as FlexiblePendulum
from models.right_angle_frame import RightAngleFrame as RightAngleFrame
from models.robot_arm import RobotArm as RobotArm
from models.rolling_wheel_set_driving import RollingWheelSetDriving as RollingWheelSetDriving
from models.shaft import Shaft as Shaft
from models.simple_pendulum import SimplePendulum as SimplePendulum
from models.slider_crank import SliderCrank as SliderCrank
from models.spin_up import SpinUp as SpinUp
from models.squeezer import Squeezer as Squeezer

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
