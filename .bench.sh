source /work/tree/navvi_ws/devel/setup.bash
export NAVVI_CACHE=${NAVVI_CACHE:-/tmp/cache}
exec /work/tree/navvi_ws/devel/lib/navvi_study/trials_bench "$@"
