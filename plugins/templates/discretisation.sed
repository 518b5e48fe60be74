# the name is the author's, and so is the literature
s#discretisation/penalty#@ID@#
s#^ \* A discretisation of the film by somebody outside#\ * @ID@: a discretisation of the film#
/\.bibtex = /,/}}",/c\
    .bibtex = "",
