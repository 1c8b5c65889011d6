#!/bin/sh
# run.sh PROGRAM ARGUMENTS: what sbatch copies and runs; the programs stay where they are.
exec "$@"
